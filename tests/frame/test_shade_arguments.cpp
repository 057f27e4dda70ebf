// Arguments of the shading kernels, by the names of their parameters.
#include <gtest/gtest.h>
#include <stdlib.h>

#include "host/core/error.h"
#include "host/frame/effects.h"
#include "host/frame/shade_arguments.h"
#include "host/ocl/upload.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

// Room for anything that a kernel of one entry reads or writes.
Buffer room() {
  return upload(device(), std::vector<float>(1024), BufferPurpose::kProbe);
}

Program shadeProgram() {
  ProgramCache cache(device());
  KernelConfig config;
  config.width = 1;
  config.glint = config.size_variation = false;
  config.planes = planesFor(config);
  return cache.get("shade.cl", config);
}

ShadeArguments inputs() {
  return ShadeArguments({room(), room(), room(), room()});
}

std::string errorOf(const ShadeArguments& arguments) {
  Kernel kernel = shadeProgram().kernel("shade");
  try {
    launchShading(kernel, arguments, 1, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class NamedParameters : public testing::Test {
 protected:
  void SetUp() override {
    if (shadeProgram().kernel("shade").parameterNames().empty())
      GTEST_SKIP() << "the device does not keep the names of parameters";
  }
};

TEST(ShadeArguments, InTheirOrderTheyLaunch) {
  ShadeArguments arguments = inputs();
  arguments.add("radiance", room());
  EXPECT_EQ(errorOf(arguments), "");
}

TEST(ShadeArguments, AreGivenOtherValuesByName) {
  ShadeArguments arguments = inputs();
  arguments.add("sample_begin", 0u);
  arguments.add("sample_count", 0u);
  arguments.set("sample_begin", 7u);
  EXPECT_EQ(std::get<std::uint32_t>(arguments.values()[4]), 7u);
  EXPECT_EQ(std::get<std::uint32_t>(arguments.values()[5]), 0u);
  EXPECT_THROW(arguments.set("sample_end", 1u), Error);
}

// A texture's buffers where the results belong: alike to the compiler, and to OpenCL.
TEST_F(NamedParameters, ABufferInAnothersPlaceIsAnErrorThatNamesBoth) {
  ShadeArguments arguments = inputs();
  arguments.add("map_texels", room());
  EXPECT_EQ(errorOf(arguments),
            "argument 4 of kernel 'shade' must be 'radiance', but 'map_texels' was given");
}

TEST_F(NamedParameters, MissingOnesAndThoseTooManyAreNamed) {
  ShadeArguments arguments = inputs();
  EXPECT_EQ(errorOf(arguments),
            "argument 4 of kernel 'shade' must be 'radiance', but nothing was given");
  arguments.add("radiance", room());
  arguments.add("cell_counts", room());
  EXPECT_EQ(errorOf(arguments),
            "argument 5 of kernel 'shade' must be nothing, but 'cell_counts' was given");
}

// Programs from the disk keep the names, too.
TEST_F(NamedParameters, ProgramsFromTheDiskTellTheSame) {
  ASSERT_EQ(setenv("GLINTMARK_PROGRAM_CACHE", "on", 1), 0);
  shadeProgram();
  const Program again = shadeProgram();
  ASSERT_EQ(setenv("GLINTMARK_PROGRAM_CACHE", "off", 1), 0);
  ASSERT_TRUE(again.fromDiskCache());
  const std::vector<std::string> wanted = {"planes", "frame", "material", "lights", "radiance"};
  EXPECT_EQ(again.kernel("shade").parameterNames(), wanted);
}

}  // namespace
}  // namespace glintmark
