# Writes OUTPUT, the C++ source that defines build_commit (build_commit.hpp) for the checkout SOURCES. The file is left
# untouched if it already has this content, so that nothing is recompiled.
#   cmake -DGIT=/usr/bin/git -DSOURCES=FOLDER -DOUTPUT=FILE -P build_commit.cmake
set(commit "unknown: built without git or outside of a git checkout")
if(GIT)
  # The path is empty only at the top of a checkout. Sources inside another project's checkout must not report its commit.
  execute_process(COMMAND ${GIT} -C ${SOURCES} rev-parse --show-cdup
                  RESULT_VARIABLE failed OUTPUT_VARIABLE way_to_top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed EQUAL 0 AND way_to_top STREQUAL "")
    execute_process(COMMAND ${GIT} -C ${SOURCES} rev-parse --short=12 --verify HEAD
                    RESULT_VARIABLE failed OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(failed EQUAL 0)
      execute_process(COMMAND ${GIT} --no-optional-locks -C ${SOURCES} status --porcelain --untracked-files=no
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      set(commit ${head})
      if(changes)
        string(APPEND commit ", with changes")
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[// SPDX-License-Identifier: GPL-3.0-or-later
// Written by tools/command_line/build_commit.cmake.
#include "tools/command_line/build_commit.hpp"

namespace crackle::tools {

const char* const build_commit = "@commit@";

}  // namespace crackle::tools
]])
