// The argument list of a shading kernel: of frames, of the ground truth and of hand-made pixels.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/ocl/compute.h"

namespace glintmark {

/// What every kernel of kernels/shade.cl and truth.cl reads first, by its names for them.
struct ShadeInputs {
  Buffer planes, frame, material, lights;
};

/// Arguments in the kernel's order, each under the name that the kernel has for it.
class ShadeArguments {
 public:
  explicit ShadeArguments(const ShadeInputs& inputs);

  void add(std::string name, KernelArg value);
  /// Gives the argument of that name, which must have been added, another value. Throws Error if
  /// there is none.
  void set(std::string_view name, KernelArg value);
  std::span<const KernelArg> values() const { return values_; }

  /// Throws Error naming the first argument that is not the kernel's parameter of that place: two
  /// buffers in each other's place would otherwise run, and shade nonsense. Where the device keeps
  /// no names, nothing is checked.
  void requireNamesOf(const Kernel& kernel) const;

 private:
  std::vector<std::string> names_;
  std::vector<KernelArg> values_;
};

/// Launches `kernel` once over `items` work-items after requireNamesOf(); whoever launches again
/// and again checks once.
LaunchTimes launchShading(Kernel& kernel, const ShadeArguments& arguments, std::size_t items,
                          std::size_t local_size);

}  // namespace glintmark
