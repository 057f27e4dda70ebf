# Everything that the program is built from is looked for here first, so that one message lists all
# that is missing, by the names that CMake knows: distributions call their packages otherwise.
set(missing "")
macro(glintmark_need kind name debian)
  if(NOT ${ARGN})
    string(APPEND missing "\n  ${kind} ${name} (Debian: ${debian})")
  endif()
endmacro()

foreach(requirement "glm libglm-dev" "TBB libtbb-dev" "fmt libfmt-dev" "hwy libhwy-dev"
        "Boost libboost-dev" "Ceres libceres-dev" "nlohmann_json nlohmann-json3-dev"
        "assimp libassimp-dev" "tomlplusplus libtomlplusplus-dev")
  separate_arguments(words UNIX_COMMAND "${requirement}")
  list(GET words 0 package)
  list(GET words 1 debian)
  find_package(${package} QUIET)
  glintmark_need(package ${package} ${debian} ${package}_FOUND)
endforeach()

# OpenCL comes from the distribution alone: a CUDA toolkit or another SDK on the search path also
# carries an (older) libOpenCL and headers, and its stub must never be linked.
find_path(GLINTMARK_OPENCL_INCLUDE CL/opencl.hpp PATHS /usr/include NO_DEFAULT_PATH
          DOC "Folder of CL/opencl.hpp")
find_library(GLINTMARK_OPENCL_LIBRARY NAMES OpenCL
             PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE} /usr/lib64 /usr/lib NO_DEFAULT_PATH
             DOC "OpenCL loader")
find_path(GLINTMARK_LIBELF_INCLUDE gelf.h DOC "libelf")
find_library(GLINTMARK_LIBELF_LIBRARY elf)
find_path(GLINTMARK_ZYDIS_INCLUDE Zydis/Zydis.h DOC "Zydis")
find_library(GLINTMARK_ZYDIS_LIBRARY Zydis)
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
# By hand, since Debian's ImathConfig.cmake, which OpenEXR's asks for, complains of a Python library.
find_path(OPENEXR_INCLUDE_DIR OpenEXR/ImfMultiPartInputFile.h)
find_path(IMATH_INCLUDE_DIR ImathBox.h PATH_SUFFIXES Imath)
find_library(OPENEXR_LIBRARY OpenEXR)
find_library(IMATH_LIBRARY Imath)
find_path(GLINTMARK_CLI11_INCLUDE CLI/CLI.hpp DOC "CLI11")
find_file(GLINTMARK_CHART_JS NAMES chart.min.js chart.umd.js
          PATHS /usr/share/javascript/chart.js /usr/share/nodejs/chart.js/dist NO_DEFAULT_PATH
          DOC "Chart.js, inlined into the report")
foreach(weight Regular Bold)
  string(TOUPPER ${weight} upper)
  find_file(GLINTMARK_FONT_${upper} Lato-${weight}.ttf
            PATHS /usr/share/fonts /usr/share/fonts/truetype /usr/share/fonts/TTF
            PATH_SUFFIXES lato lato-fonts NO_DEFAULT_PATH DOC "Font of the pictures")
endforeach()
foreach(file "OPENCL_INCLUDE|CL/opencl.hpp|opencl-clhpp-headers" "OPENCL_LIBRARY|libOpenCL|ocl-icd-opencl-dev"
        "LIBELF_INCLUDE|gelf.h|libelf-dev" "LIBELF_LIBRARY|libelf|libelf-dev"
        "ZYDIS_INCLUDE|Zydis/Zydis.h|libzydis-dev" "ZYDIS_LIBRARY|libZydis|libzydis-dev"
        "CLI11_INCLUDE|CLI/CLI.hpp|libcli11-dev" "CHART_JS|chart.min.js|libjs-chart.js"
        "FONT_REGULAR|Lato-Regular.ttf|fonts-lato" "FONT_BOLD|Lato-Bold.ttf|fonts-lato")
  string(REPLACE "|" ";" words "${file}")
  list(GET words 0 variable)
  list(GET words 1 name)
  list(GET words 2 debian)
  glintmark_need(file "${name}, GLINTMARK_${variable}" ${debian} GLINTMARK_${variable})
endforeach()
foreach(variable OPENIMAGEIO_INCLUDE_DIR OPENIMAGEIO_LIBRARY OPENIMAGEIO_UTIL_LIBRARY)
  glintmark_need(file "of OpenImageIO, ${variable}" libopenimageio-dev ${variable})
endforeach()
foreach(variable OPENEXR_INCLUDE_DIR IMATH_INCLUDE_DIR OPENEXR_LIBRARY IMATH_LIBRARY)
  glintmark_need(file "of OpenEXR, ${variable}" libopenexr-dev ${variable})
endforeach()
if(GLINTMARK_TESTS)
  find_package(GTest QUIET)
  glintmark_need(package "GTest (or -D GLINTMARK_TESTS=OFF)" libgtest-dev GTest_FOUND)
endif()
if(GLINTMARK_BENCHMARKS)
  find_package(benchmark QUIET)
  glintmark_need(package "benchmark (or -D GLINTMARK_BENCHMARKS=OFF)" libbenchmark-dev
                 benchmark_FOUND)
endif()

if(missing)
  message(FATAL_ERROR "These are not installed, or not where CMake looks (CMAKE_PREFIX_PATH, or the "
                      "variable beside each file):${missing}")
endif()
