# Copies the kernels to OUTPUT as a driver without the compiler's vector reductions sees them:
# oclgrind's simulator knows none, and the path for such drivers gets its test.
#   cmake -D KERNELS=folder -D OUTPUT=folder -P portable_kernels.cmake
file(COPY ${KERNELS}/ DESTINATION ${OUTPUT})
file(READ ${OUTPUT}/wide/wide.clh text)
string(REPLACE "#if defined(__has_builtin)" "#if 0" portable "${text}")
if(portable STREQUAL text)
  message(FATAL_ERROR "wide.clh no longer asks for the compiler's reductions as expected")
endif()
file(WRITE ${OUTPUT}/wide/wide.clh "${portable}")
