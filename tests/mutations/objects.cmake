# A mutation compiles its one source: libraries are built with one object a source, tests as the preset says.
cmake_language(DEFER CALL
  set_target_properties articular_fem articular_collision articular_sim articular_study articular_error_bars PROPERTIES UNITY_BUILD OFF)
