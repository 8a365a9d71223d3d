# Fails if a program needs a shared library that is not on the list of those that the servo's side may link: the language's
# and the system's own, zlib, and libusb for devices. None of them is a vision library or under the GPL.
# Run: cmake -DPROGRAM=<file> -P cmake/CheckLinks.cmake
cmake_minimum_required(VERSION 3.25)
set(allowed "^(linux-vdso|ld-linux-[a-z0-9-]+|libc|libm|libstdc\\+\\+|libgcc_s|libz|libpthread|libdl|librt|libusb-1\\.0|libudev|libcap"
            "|libasan|libubsan|libtsan|libgcov)\\.so")
string(JOIN "" allowed ${allowed})

execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" lines "${text}")
set(seen 0)
foreach(line ${lines})
  string(REGEX REPLACE "^[ \t]*([^ \t]+).*$" "\\1" library "${line}")
  get_filename_component(library "${library}" NAME)
  if(library STREQUAL "")
    continue()
  endif()
  math(EXPR seen "${seen} + 1")
  if(NOT library MATCHES "${allowed}")
    message(SEND_ERROR "the servo's side may not link ${library}")
  endif()
endforeach()
if(seen LESS 3)
  message(FATAL_ERROR "ldd lists only ${seen} libraries of ${PROGRAM}: nothing was checked")
endif()
message(STATUS "${seen} libraries, all allowed")
