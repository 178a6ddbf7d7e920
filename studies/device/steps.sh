# SPDX-License-Identifier: BSD-3-Clause
# For the scripts of this study: commands with times of their own, all together within $LIMIT seconds. Expects $out.
begin=$SECONDS
steps=""

# step NAME SECONDS COMMAND...: runs a command within its time, its output in OUT/NAME.log; notes how it ended.
step() {
  local name=$1 time=$2 left=$((LIMIT - SECONDS + begin)) from=$SECONDS code
  shift 2
  if [ "$left" -lt 5 ]; then
    code=124
    echo "no time was left" > "$out/$name.log"
  else
    timeout -k 5 $((time < left ? time : left)) "$@" > "$out/$name.log" 2>&1
    code=$?
  fi
  echo "$name: exit code $code, $((SECONDS - from)) s"
  steps="$steps${steps:+, }{\"step\": \"$name\", \"exit_code\": $code, \"seconds\": $((SECONDS - from))}"
  return $code
}
