# Runs PROGRAM for a moment, only benchmarks that match FILTER (empty: all), and reads what it wrote to
# OUTPUT: where it ran, and a time for every benchmark.
execute_process(
  COMMAND ${PROGRAM} --benchmark_min_time=0.001 "--benchmark_filter=${FILTER}"
          --benchmark_out=${OUTPUT} --benchmark_out_format=json
  RESULT_VARIABLE exit_code OUTPUT_QUIET ERROR_VARIABLE messages)
if(NOT exit_code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${exit_code}: ${messages}")
endif()
file(READ ${OUTPUT} json)

set(facts cpu git command)
get_filename_component(name ${PROGRAM} NAME_WE)
if(NOT name MATCHES "^bench_(raster|em|maps)$")
  list(APPEND facts device driver platform width)
endif()
foreach(fact ${facts})
  string(JSON value GET "${json}" context ${fact})
  if(value STREQUAL "")
    message(FATAL_ERROR "${OUTPUT} does not say '${fact}'")
  endif()
endforeach()

string(JSON count LENGTH "${json}" benchmarks)
if(count EQUAL 0)
  message(FATAL_ERROR "${OUTPUT} has no benchmark")
endif()
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON benchmark GET "${json}" benchmarks ${i})
  string(JSON error ERROR_VARIABLE no_error GET "${benchmark}" error_message)
  string(JSON time GET "${benchmark}" real_time)
  if(no_error STREQUAL "NOTFOUND" OR NOT time GREATER 0)
    message(FATAL_ERROR "${OUTPUT} has no time in ${benchmark}")
  endif()
endforeach()
