# Run at build time: cmake -DWHIPPLE_... -P build_info.cmake. A configure-time revision would go stale with the next commit.
set(WHIPPLE_REVISION "unknown")
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS "${WHIPPLE_SOURCE_DIR}/.git")
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${WHIPPLE_SOURCE_DIR} rev-parse --short=12 HEAD
                  OUTPUT_VARIABLE WHIPPLE_REVISION OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed)
    set(WHIPPLE_REVISION "unknown")
  else()
    execute_process(COMMAND ${GIT_EXECUTABLE} --no-optional-locks -C ${WHIPPLE_SOURCE_DIR} status --porcelain --untracked-files=no
                    OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      string(APPEND WHIPPLE_REVISION "+changes")
    endif()
  endif()
endif()
configure_file(${WHIPPLE_SOURCE_DIR}/src/app/build_info.cpp.in ${OUTPUT} @ONLY)
