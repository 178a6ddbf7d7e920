# Installs the headers as <whipple/...>: "src/solver/ledger.hpp" as <whipple/solver/ledger.hpp>, "eos/state.hpp" as
# <whipple/eos/state.hpp>, with their includes of one another. Before: source, headers (folder below the prefix).
set(target $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${headers})
message(STATUS "Installing: ${target}")
file(GLOB_RECURSE paths RELATIVE ${source} ${source}/src/*.hpp ${source}/eos/*.hpp)
list(FILTER paths EXCLUDE REGEX "^src/(app|bench|core/process|decks)/")
foreach(path IN LISTS paths)
  file(READ ${source}/${path} text)
  string(REGEX REPLACE "#include \"(src/)?([^\"]+)\"" "#include <whipple/\\2>" text "${text}")
  string(REGEX REPLACE "^src/" "" path ${path})
  file(WRITE ${target}/${path} "${text}")
endforeach()
