# Debian's compiler for ARM's 64-bit processors, with the libraries of the Debian 12 in WHIPPLE_SYSROOT, which
# `scripts/debian_root.py FOLDER --architecture arm64` unpacks; programs run by QEMU (preset `aarch64`).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(WHIPPLE_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../build/debian_arm64 CACHE PATH "Unpacked Debian 12 for arm64")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WHIPPLE_SYSROOT)
file(REAL_PATH ${WHIPPLE_SYSROOT} CMAKE_SYSROOT)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc-12)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++-12)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# What CMake finds by asking mpicc and h5pcc, which are programs for the other processor.
set(libraries ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu)
foreach(language C CXX)
  set(MPI_${language}_LIB_NAMES mpi CACHE STRING "")
  set(MPI_${language}_HEADER_DIR ${libraries}/openmpi/include CACHE PATH "")
endforeach()
set(MPI_mpi_LIBRARY ${libraries}/openmpi/lib/libmpi.so CACHE FILEPATH "")
set(MPI_CXX_SKIP_MPICXX ON CACHE BOOL "")
set(HDF5_ROOT ${libraries}/hdf5/openmpi CACHE PATH "")

find_program(QEMU_AARCH64 NAMES qemu-aarch64-static qemu-aarch64)
set(CMAKE_CROSSCOMPILING_EMULATOR ${QEMU_AARCH64} -L ${CMAKE_SYSROOT})
