# Runs VAGUS twice, the second time as on a processor without FMA and AVX2: PLAN in WORLD gives the same bytes.
#     cmake -DVAGUS=… -DPLAN=… -DWORLD=… -DFOLDER=… -P same_bits.cmake
foreach(run IN ITEMS all older)
  set(trace ${FOLDER}/${run}.trace)
  set(tunables)
  if(run STREQUAL older)
    set(tunables GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2)
  endif()
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env ${tunables}
            ${VAGUS} plan run ${PLAN} --world ${WORLD} --clock virtual --trace-all ${trace}
    RESULT_VARIABLE status)
  if(NOT status EQUAL 3)
    message(FATAL_ERROR "the plan ended with ${status}, not with 3, interrupted by its button")
  endif()
  file(SIZE ${trace} size)
  if(size LESS 100000)
    message(FATAL_ERROR "${trace} has only ${size} bytes")
  endif()
  file(SHA256 ${trace} ${run}_sum)
endforeach()
if(NOT all_sum STREQUAL older_sum)
  message(FATAL_ERROR "the two traces in ${FOLDER} differ")
endif()
