# The files of presets/ as C++ text: a list of {name, text} that tyndall/document/preset.cc includes.
include_guard(GLOBAL)

# tyndall_preset_list(file): writes it, and configures anew when a preset changes, comes or goes.
function(tyndall_preset_list file)
  file(GLOB presets CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/presets/*.medium.json")
  list(SORT presets)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${presets})
  set(list "")
  foreach(preset IN LISTS presets)
    get_filename_component(name "${preset}" NAME)
    string(REPLACE ".medium.json" "" name "${name}")
    file(READ "${preset}" text)
    string(APPEND list "{\"${name}\", R\"preset(${text})preset\"},\n")
  endforeach()
  file(GENERATE OUTPUT "${file}" CONTENT "${list}")
endfunction()
