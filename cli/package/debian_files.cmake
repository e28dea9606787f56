# Run by CPack on the files of a Debian package before they are packed: adds
# copyright and changelog, compresses a man page, and takes out of static
# libraries what no linker needs.
cmake_policy(VERSION 3.25)
find_program(gzip gzip REQUIRED)

function(pack file)
  execute_process(COMMAND ${gzip} -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
  file(CHMOD ${file}.gz
    PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()

file(READ ${CPACK_ERRMAP_SOURCE}/LICENSE licence)
string(REGEX MATCH "Copyright[^\n]*" copyright "${licence}")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  string(TOUPPER ${component} key)
  set(documents
    ${root}/usr/share/doc/${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  file(WRITE ${documents}/copyright
    "errmap ${CPACK_PACKAGE_VERSION}\n\n${copyright}\n\n${licence}")
  # In Debian's form; what changed is in CHANGELOG.md.
  file(WRITE ${documents}/changelog
"errmap (${CPACK_PACKAGE_VERSION}) stable; urgency=medium

  * See CHANGELOG.md of this version.

 -- ${CPACK_PACKAGE_CONTACT}  Wed, 25 Nov 2026 00:00:00 +0000
")
  pack(${documents}/changelog)
  # Where Debian's zsh looks.
  if(EXISTS ${root}/usr/share/zsh/site-functions)
    file(RENAME ${root}/usr/share/zsh/site-functions
      ${root}/usr/share/zsh/vendor-completions)
  endif()
  file(GLOB pages ${root}/usr/share/man/man1/*.1)
  foreach(page IN LISTS pages)
    pack(${page})
  endforeach()
  file(GLOB libraries ${root}/usr/lib/*.a ${root}/usr/lib/*/*.a)
  foreach(library IN LISTS libraries)
    execute_process(
      COMMAND ${CPACK_ERRMAP_STRIP} --strip-debug --remove-section=.comment
              --remove-section=.note --enable-deterministic-archives ${library}
      COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
