# gyre_add_test(FOLDER NAME LINK targets... LABELS labels... [SOURCES extra files...])
# builds tests/FOLDER/NAME_test.cpp with GoogleTest and registers it as FOLDER/NAME.
# Labels decide how it runs: `scenario`, `ui`, `gl` and `long` get the machine to themselves, for they
# use all cores or watch the clock; `ui` draws without a screen; `data` may be skipped for want of it,
# `pty` for want of pseudo terminals.
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
endif()
function(gyre_add_test folder name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(arg "" "TIMEOUT" "LINK;LABELS;SOURCES" ${ARGN})
  string(REPLACE "/" "_" target "${folder}/${name}_test")
  add_executable(${target} "${PROJECT_SOURCE_DIR}/tests/${folder}/${name}_test.cpp" ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE ${arg_LINK} GTest::gmock GTest::gtest_main gyre::strict)
  add_test(NAME ${folder}/${name} COMMAND ${target})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(GYRE_SANITIZE)  # pictures are rendered and searched some ten times slower then
    math(EXPR arg_TIMEOUT "${arg_TIMEOUT} * 8")
  endif()
  set_tests_properties(${folder}/${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
  foreach(label IN ITEMS scenario ui gl long)
    if(label IN_LIST arg_LABELS)
      set_tests_properties(${folder}/${name} PROPERTIES RUN_SERIAL ON)
    endif()
  endforeach()
  if("ui" IN_LIST arg_LABELS AND NOT "gl" IN_LIST arg_LABELS)
    set_tests_properties(${folder}/${name} PROPERTIES ENVIRONMENT QT_QPA_PLATFORM=offscreen)
  endif()
  # Logs of wires belong to whoever uses the program, not to its tests.
  set_property(TEST ${folder}/${name} APPEND PROPERTY
    ENVIRONMENT "XDG_CACHE_HOME=${PROJECT_BINARY_DIR}/tests/cache")
  foreach(label IN ITEMS data pty)
    if(label IN_LIST arg_LABELS)
      set_tests_properties(${folder}/${name} PROPERTIES
        SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]|: Skipped")
    endif()
  endforeach()
endfunction()
