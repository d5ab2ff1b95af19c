# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# cmake -DNM=nm -DOBJECTS=a.o;b.o -P wide_symbols.cmake
# Objects compiled for AVX2 or AVX-512 may share no inline function with the rest of the program: the linker keeps one
# copy of each, and a CPU without those instructions must not meet theirs.
foreach(object IN LISTS OBJECTS)
    if(NOT object MATCHES "(filters|kernels|materials|shade)_(avx2|avx512)\\.cpp")
        continue()
    endif()
    set(own "target_core::kernels_${CMAKE_MATCH_2}(_without_lobes)?::")
    execute_process(COMMAND ${NM} -C ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[^\n]+ [WV] [^\n]+" shared "${symbols}")
    foreach(symbol IN LISTS shared)
        if(NOT symbol MATCHES "${own}")
            message(SEND_ERROR "${object} shares this function with objects for other CPUs: ${symbol}")
        endif()
    endforeach()
    message("looked at ${object}")
    set(seen TRUE)
endforeach()
if(NOT seen)
    message(SEND_ERROR "no object of a wide backend in ${OBJECTS}")
endif()
