// PoCL keeps every kernel it compiles in a cache of its own; the tests' kernels do not belong into
// the user's.
#include <memory>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

class PoclCache : public testing::Environment {
 public:
  void SetUp() override {
    folder_ = std::make_unique<TemporaryFolder>();
    setenv("POCL_CACHE_DIR", folder_->path().c_str(), 1);
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::unique_ptr<TemporaryFolder> folder_;
};

// GoogleTest owns the environment.
[[maybe_unused]] const testing::Environment* const kPoclCache =
    testing::AddGlobalTestEnvironment(new PoclCache);

}  // namespace
}  // namespace glintmark
