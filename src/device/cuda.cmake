# The compiler of graphics processors: WHIPPLE_HAS_CUDA, and how the kernels are compiled. CMake's module finds nvcc also where
# the command on the PATH is a script that calls it.
set(WHIPPLE_CUDA AUTO CACHE STRING "Kernels for graphics processors: AUTO (if nvcc 12 or later is found), ON, OFF")
set(WHIPPLE_CUDA_ARCHITECTURE 90 CACHE STRING "Compute capability of the graphics processor (90: H100, H200)")
set(WHIPPLE_HAS_CUDA OFF)
if(NOT WHIPPLE_CUDA STREQUAL "OFF")
  find_package(CUDAToolkit 12 QUIET)
  if(TARGET CUDA::cudart_static AND CUDAToolkit_NVCC_EXECUTABLE)
    set(WHIPPLE_HAS_CUDA ON)
  elseif(WHIPPLE_CUDA STREQUAL "ON")
    message(FATAL_ERROR "WHIPPLE_CUDA=ON: nvcc 12 or later with the library cudart_static was not found")
  endif()
endif()

# The compiler's cache keeps what nvcc makes, and what it prints.
if(CCACHE AND NOT CMAKE_CUDA_COMPILER_LAUNCHER)
  set(CMAKE_CUDA_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
endif()

# whipple_gpu_objects(ROOT): sets whipple_gpu_objects to the objects of all kernels, made from the sources under ROOT: those
# of three dimensions (gpu) and of two (gpu_section). Beside each lies a log, which says how many registers each kernel
# takes (scripts/device_registers.py).
set(whipple_device_folder ${CMAKE_CURRENT_LIST_DIR})
function(whipple_gpu_objects root)
  set(objects)
  foreach(part gpu gpu_section)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${part}.o)
    set(log ${CMAKE_CURRENT_BINARY_DIR}/${part}.log)
    add_custom_command(
      OUTPUT ${object}
      BYPRODUCTS ${log}
      COMMAND ${CMAKE_COMMAND} -DLOG=${log} -P ${whipple_device_folder}/keep_log.cmake --
              ${CMAKE_CUDA_COMPILER_LAUNCHER} ${CUDAToolkit_NVCC_EXECUTABLE} -std=c++20 -O3 -arch=sm_${WHIPPLE_CUDA_ARCHITECTURE}
              --expt-relaxed-constexpr --expt-extended-lambda -Xcompiler=-march=x86-64-v3,-fPIC -Xptxas=-v,-warn-spills
              -I${root} -MD -MF ${object}.d -c ${whipple_device_folder}/${part}.cu -o ${object}
      DEPFILE ${object}.d
      WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}  # where the relative paths begin that the cache writes into the DEPFILE
      DEPENDS ${whipple_device_folder}/${part}.cu
      COMMENT "Building kernels for the graphics processor: ${part}" VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  set(whipple_gpu_objects ${objects} PARENT_SCOPE)
endfunction()
