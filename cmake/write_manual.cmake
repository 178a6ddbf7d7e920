# Writes the manual page and what shells read for completion: cmake -DWHIPPLE=PROGRAM -DFOLDER=FOLDER -P write_manual.cmake
file(MAKE_DIRECTORY ${FOLDER})
set(ENV{ASAN_OPTIONS} detect_leaks=0)  # of a build with sanitizers: looked for by the tests, not here
function(write_output file)
  execute_process(COMMAND ${WHIPPLE} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
write_output(whipple.bash completion bash)
write_output(_whipple completion zsh)
write_output(whipple.fish completion fish)
write_output(whipple.1 man)
execute_process(COMMAND gzip -9nkf ${FOLDER}/whipple.1 COMMAND_ERROR_IS_FATAL ANY)
