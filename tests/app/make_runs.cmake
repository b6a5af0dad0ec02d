# Leaves the reports of a few runs in folders of OUT, for the tests in a browser. Usage: cmake -DPROGRAM=.. -DOUT=.. -P
# make_runs.cmake, in the root of the sources.
function(run name code)
  execute_process(COMMAND ${PROGRAM} run ${ARGN} --out ${OUT}/${name} --quiet RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(NOT result EQUAL code)
    message(FATAL_ERROR "${name} ended with ${result}, not with ${code}: ${errors}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${OUT})
run(housing 0 examples/programs/housing.h --setup examples/setups/housing-tnc640.toml --clearance)
run(lathe 0 examples/programs/shaft.mpf --setup examples/setups/shaft-lathe.toml)
# The part lies 12.4 mm lower than the control thinks: beyond the reach of a touch.
file(READ examples/setups/housing-tnc640.toml setup)
string(REGEX REPLACE "(pose = {[^}]*z = )-?[0-9.]+" "\\1-482" lower "${setup}")
if(lower STREQUAL setup)
  message(FATAL_ERROR "the setup of the housing has no pose to change")
endif()
string(REPLACE "../" "${CMAKE_CURRENT_SOURCE_DIR}/examples/" lower "${lower}")
file(WRITE ${OUT}/lower.toml "${lower}")
run(alarm 3 examples/programs/housing.h --setup ${OUT}/lower.toml)
