# What is installed beside the program and the libraries: scenarios and documentation.

# articular_install_files(DESTINATION PATTERN...): files of the source tree, in the same folders as there. Unlike
# install(DIRECTORY) it leaves no empty ones.
function(articular_install_files destination)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/)
  file(GLOB_RECURSE files RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${ARGN})
  foreach(file ${files})
    get_filename_component(folder ${file} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${destination}/${folder} COMPONENT program)
  endforeach()
endfunction()

foreach(ending toml csv vtp vtu)
  articular_install_files(share/articular scenarios/*.${ending})
endforeach()
# Whole, so that links from page to page lead somewhere.
install(FILES README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
foreach(folder scenarios tools fem collision sim parallel tests/benchmarks)
  articular_install_files(${CMAKE_INSTALL_DOCDIR} ${folder}/*.md ${folder}/*.png ${folder}/*.svg)
endforeach()
