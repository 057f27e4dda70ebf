#include <gtest/gtest.h>
#include "host/ocl/compute.h"
#include "host/core/shared_types.h"
using namespace glintmark;
TEST(Device, Basic) {
  Device d;
  ProgramCache cache(d);
  KernelConfig c; c.width=16;
  Program p = cache.get("probe.cl", c);
  printf("%s %d %f ms %s\n", p.options().c_str(), p.fromDiskCache(), p.buildNs()*1e-6, d.info().name.c_str());
  Buffer b(d, 64, "sizes");
  KernelArg a[] = {b};
  auto t = p.kernel("probeTypeSizes").launch(a, 1, 1);
  uint32_t s[3]; b.read(s, 12);
  for (int i=0;i<3;i++) EXPECT_EQ(s[i], kSharedTypeSizes[i]);
  printf("%f %f %zu\n", t.event_ns, t.wall_ns, p.binary().size());
}
