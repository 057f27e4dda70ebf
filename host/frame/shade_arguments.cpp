#include "host/frame/shade_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/core/error.h"

namespace glintmark {

ShadeArguments::ShadeArguments(const ShadeInputs& inputs) {
  add("planes", inputs.planes);
  add("frame", inputs.frame);
  add("material", inputs.material);
  add("lights", inputs.lights);
}

void ShadeArguments::add(std::string name, KernelArg value) {
  names_.push_back(std::move(name));
  values_.push_back(std::move(value));
}

void ShadeArguments::set(std::string_view name, KernelArg value) {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) throw Error(fmt::format("no argument is called '{}'", name));
  values_[static_cast<std::size_t>(found - names_.begin())] = std::move(value);
}

void ShadeArguments::requireNamesOf(const Kernel& kernel) const {
  const std::vector<std::string>& wanted = kernel.parameterNames();
  if (wanted.empty()) return;
  const std::size_t count = std::max(wanted.size(), names_.size());
  const auto name = [](const std::vector<std::string>& names, std::size_t i) {
    return i < names.size() ? "'" + names[i] + "'" : std::string("nothing");
  };
  for (std::size_t i = 0; i < count; ++i)
    if (i >= wanted.size() || i >= names_.size() || wanted[i] != names_[i])
      throw Error(fmt::format("argument {} of kernel '{}' must be {}, but {} was given", i,
                              kernel.name(), name(wanted, i), name(names_, i)));
}

LaunchTimes launchShading(Kernel& kernel, const ShadeArguments& arguments, std::size_t items,
                          std::size_t local_size) {
  arguments.requireNamesOf(kernel);
  return kernel.launch(arguments.values(), items, local_size);
}

}  // namespace glintmark
