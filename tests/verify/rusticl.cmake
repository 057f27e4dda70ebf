# Runs the checks of PROGRAM that ONLY matches on Mesa's rusticl, on llvmpipe and alone, and from Mesa 25
# on those that ONLY_FROM_MESA_25 matches. Says "skipped: …" where the system has none.
#   cmake -D PROGRAM=glintmark -D ONLY=regex -D ONLY_FROM_MESA_25=regex -D FOLDER=scratch
#         [-D ICDS=files] -P rusticl.cmake
if(NOT ICDS)
  file(GLOB ICDS /etc/OpenCL/vendors/*rusticl*.icd)
endif()
if(NOT ICDS)
  message(STATUS "skipped: rusticl (mesa-opencl-icd) is not installed")
  return()
endif()
# The loader takes all that a folder holds.
file(REMOVE_RECURSE ${FOLDER})
file(COPY ${ICDS} DESTINATION ${FOLDER})
set(ENV{OCL_ICD_VENDORS} ${FOLDER})
set(ENV{RUSTICL_ENABLE} llvmpipe)
execute_process(COMMAND ${PROGRAM} info RESULT_VARIABLE exit_code OUTPUT_VARIABLE output
                ERROR_VARIABLE errors)
message(STATUS "${output}${errors}")
if(exit_code EQUAL 3)
  message(STATUS "skipped: rusticl has no llvmpipe here")
  return()
endif()
if(NOT exit_code EQUAL 0)
  message(FATAL_ERROR "info ended with exit code ${exit_code}")
endif()
if(output MATCHES "driver +([0-9]+)\\." AND CMAKE_MATCH_1 GREATER_EQUAL 25)
  set(ONLY "(${ONLY})|(${ONLY_FROM_MESA_25})")
endif()
execute_process(COMMAND ${PROGRAM} verify --timeout 300 --only ${ONLY} RESULT_VARIABLE exit_code)
if(NOT exit_code EQUAL 0)
  message(FATAL_ERROR "verify ended with exit code ${exit_code}")
endif()
