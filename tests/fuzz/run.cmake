# Runs one fuzzer for a bounded time, quietly unless it fails.
#   cmake -DFUZZER=... -DCORPUS=... -DSEEDS=... -DSECONDS=... -P run.cmake
get_filename_component(name ${FUZZER} NAME)
get_filename_component(folder ${FUZZER} DIRECTORY)
set(log ${folder}/${name}.log)
file(REMOVE_RECURSE ${CORPUS})
file(MAKE_DIRECTORY ${CORPUS})
# Leaks are not looked for: decoders below OpenImageIO lose memory on damaged files.
set(ENV{ASAN_OPTIONS} detect_leaks=0:allocator_may_return_null=1)
execute_process(
  COMMAND ${FUZZER} ${CORPUS} ${SEEDS} -seed=1 -max_total_time=${SECONDS} -max_len=20000
          -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix=${folder}/${name}-
  OUTPUT_FILE ${log} ERROR_FILE ${log} RESULT_VARIABLE failed)
file(STRINGS ${log} runs REGEX "number_of_executed_units|peak_rss_mb")
string(REPLACE "stat::" "" runs "${runs}")
string(REGEX REPLACE " +" " " runs "${runs}")
if(failed)
  file(READ ${log} text)
  string(LENGTH "${text}" length)
  if(length GREATER 8000)
    math(EXPR start "${length} - 8000")
    string(SUBSTRING "${text}" ${start} -1 text)
  endif()
  message(FATAL_ERROR "${text}\n${name} failed (${failed}); its input is ${folder}/${name}-*")
endif()
message(STATUS "${name}: ${runs}")
