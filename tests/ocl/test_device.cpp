#include <gtest/gtest.h>
#include "host/ocl/compute.h"
#include "host/ocl/static_counts.h"
#include "host/core/shared_types.h"
#include <chrono>
using namespace glintmark;
TEST(Device, Counts) {
  Device d;
  ProgramCache cache(d);
  for (const char* o : {"-D WIDTH=16","-D WIDTH=1"}) {
  Program p = cache.getWithOptions("probe.cl", o);
  for (const char* k : {"probeFma","probeTriad"}) {
  auto t0=std::chrono::steady_clock::now();
  auto c = staticCounts(p,k);
  printf("%s %s %d %f s\n", o, k, c.has_value(),std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count());
  if(c){ printf("%zu %zu %zu\n", c->kernel_instructions,c->cell_loop_instructions,c->vector_512); for(auto&l:c->loops) printf("   %zu %zu %zu %d %d\n", l.instructions,l.vector_512,l.calls,l.depth,(int)l.longest_inner);}
  }}
}
