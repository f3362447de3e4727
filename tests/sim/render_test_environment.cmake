# Read by ctest after it has asked the program for its tests. The OpenGL driver leaks, and is unloaded
# before leaks are reported, so that they can't be told from ours by name: there is no looking for leaks.
set_tests_properties(${render_tests_TESTS} PROPERTIES ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
