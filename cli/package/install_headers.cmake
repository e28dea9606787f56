# Run by `cmake --install`: writes the public headers, and those that they
# include, below `ERRMAP_INCLUDE`/errmap, where they include each other by that
# name; and errmap.h, which includes all of the public ones.
#
# ERRMAP_SOURCE: root of the sources; ERRMAP_SLICES: those with headers of their
# own.
cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)
foreach(slice IN LISTS ERRMAP_SLICES)
  include(${ERRMAP_SOURCE}/cli/${slice}/public_headers.cmake)
endforeach()

set(waiting ${ERRMAP_PUBLIC_HEADERS})
set(done "")
while(waiting)
  list(POP_FRONT waiting header)
  list(APPEND done ${header})
  file(READ ${ERRMAP_SOURCE}/${header} text)
  set(own "#include \"((cli/[a-z_]+|data|fitting|models|stats)/[^\"]+)\"")
  string(REGEX MATCHALL "${own}" includes "${text}")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "${own}" "\\1" included "${include}")
    if(NOT included IN_LIST done AND NOT included IN_LIST waiting)
      list(APPEND waiting ${included})
    endif()
  endforeach()
  string(REGEX REPLACE "${own}" "#include \"errmap/\\1\"" text "${text}")
  string(REPLACE "#pragma once\n" "#pragma once\n
#if __cplusplus < 202002L
#error errmap needs C++20: compile with -std=c++20
#endif
" text "${text}")
  file(WRITE ${ERRMAP_INCLUDE}/errmap/${header} "${text}")
endwhile()

set(umbrella "#pragma once\n\n// The whole public interface of errmap.\n\n")
foreach(header IN LISTS ERRMAP_PUBLIC_HEADERS)
  string(APPEND umbrella "#include \"errmap/${header}\"\n")
endforeach()
file(WRITE ${ERRMAP_INCLUDE}/errmap/errmap.h "${umbrella}")
list(LENGTH done count)
message(STATUS "Installing: ${count} headers in ${ERRMAP_INCLUDE}/errmap")
