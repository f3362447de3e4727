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

foreach(ending toml set csv vtp vtu)
  articular_install_files(share/articular scenarios/*.${ending})
endforeach()
# Whole, so that links from page to page lead somewhere.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
articular_install_files(${CMAKE_INSTALL_DOCDIR} tools/python/examples/*.py tools/python/examples/*.toml scenarios/*.json
  tests/README.md)
foreach(folder scenarios tools fem collision sim parallel tests/benchmarks)
  articular_install_files(${CMAKE_INSTALL_DOCDIR} ${folder}/*.md ${folder}/*.png ${folder}/*.svg)
endforeach()

# Debian packages, by `cpack -G DEB` (tools/package): the program; the mesher, since it alone is bound by CGAL's GPL 3 and
# most runs do without; libraries and headers; the Python package, where the build has it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME articular)
set(CPACK_PACKAGE_CONTACT "The articular developers <developers@articular.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program parallel fem collision sim)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(this_version "= ${PROJECT_VERSION}-1")
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # cpack needs no tests

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME articular)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS xvfb)  # pictures without a display
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "articular-mesher (${this_version}), gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, libarticular-dev, paraview")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "finite-element simulator of jaw and knee tissue
articular simulates the soft tissue of jaw and knee: tetrahedral tissue and
rigid bones, moved by muscles, held by ligaments and kept apart by contact.
You write a scenario file and run it; no display is needed. Frames for
ParaView, curves and pictures come out, each number with an error bar if you
ask for it.
.
Scenarios of a jaw that opens, bites and clenches and of a knee under load
are part of the package.")

set(CPACK_DEBIAN_MESHER_PACKAGE_NAME articular-mesher)
set(CPACK_DEBIAN_MESHER_PACKAGE_SECTION science)
set(CPACK_DEBIAN_MESHER_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MESHER_PACKAGE_DEPENDS "articular (${this_version})")
set(CPACK_DEBIAN_MESHER_DESCRIPTION "tetrahedra from closed surfaces for articular
With this package `articular mesh` fills closed surfaces, such as segmented
scans, with tetrahedra. It uses Mesh_3 of CGAL, and so is under the GPL,
version 3 or later.")

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libarticular-dev)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS "libccd-dev, libeigen3-dev, libexpat1-dev, libfmt-dev, liblz4-dev, liblzma-dev, libopenblas-dev, libsuitesparse-dev, libsundials-dev (>= 6.4), libtomlplusplus-dev, libvtk9-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_DEBIAN_LIBRARIES_DESCRIPTION "libraries and headers of articular, a simulator of joint tissue
For programs of your own: finite elements and materials (articular-fem),
contact search (articular-collision), and whole simulations (articular-sim),
as CMake packages with static libraries.")

# The module is for one version of Python, which has its name.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-articular)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "articular (${this_version}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-scipy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-meshio")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "simulator of joint tissue from Python
With this package Python runs scenarios of articular, goes through them step
by step, steers muscles and reads results as numpy arrays, or as objects of
pandas and meshio. Its contact search and finite elements work alone too, on
meshes of your own.")

file(STRINGS CHANGELOG.md released REGEX "^## ${PROJECT_VERSION} - ${articular_release_date}$")
if(NOT released)
  message(FATAL_ERROR "CHANGELOG.md has no heading `## ${PROJECT_VERSION} - ${articular_release_date}`, the version of "
    "CMakeLists.txt and the date of CITATION.cff")
endif()
execute_process(COMMAND date --rfc-email --utc --date ${articular_release_date}
  OUTPUT_VARIABLE debian_date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(debian_folder ${PROJECT_BINARY_DIR}/debian)
configure_file(tools/debian/changelog.in ${debian_folder}/changelog.Debian @ONLY)
configure_file(CHANGELOG.md ${debian_folder}/changelog COPYONLY)
foreach(file changelog changelog.Debian)
  execute_process(COMMAND gzip --best --no-name --stdout ${debian_folder}/${file}
    OUTPUT_FILE ${debian_folder}/${file}.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()
function(articular_package_documents package component)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/debian/copyright ${debian_folder}/changelog.gz ${debian_folder}/changelog.Debian.gz
    DESTINATION share/doc/${package} COMPONENT ${component})
endfunction()
articular_package_documents(articular program)
articular_package_documents(libarticular-dev parallel)
if(TARGET articular_mesher)
  articular_package_documents(articular-mesher mesher)
  list(APPEND CPACK_COMPONENTS_ALL mesher)
endif()

get_target_property(kind_of_python articular_python TYPE)
if(kind_of_python STREQUAL "MODULE_LIBRARY")
  articular_package_documents(python3-articular python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

include(CPack)
foreach(library parallel fem collision sim)
  cpack_add_component(${library} GROUP libraries)
endforeach()
cpack_add_component_group(libraries)
