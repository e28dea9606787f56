# arm64 by Debian's cross compiler, what is built run by qemu-user-static:
#
#   cmake --preset release --toolchain cli/package/aarch64.cmake
#
# Needs g++-aarch64-linux-gnu, qemu-user-static and, after
# `dpkg --add-architecture arm64`, the libraries of quickstart.sh with :arm64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
# Before amd64's, which stand in /usr, too.
set(CMAKE_PREFIX_PATH /usr/lib/aarch64-linux-gnu)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig)
