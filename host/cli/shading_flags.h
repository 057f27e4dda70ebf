// Options about shading that several commands have.
#pragma once
#include <string>
#include <vector>

#include "host/cli/command.h"
#include "host/frame/shading_options.h"
#include "host/ocl/switches.h"
#include "host/scene/scene.h"

namespace glintmark {

/// What the command line says of methods and of what bounds their cost. Lives as long as the
/// parser.
class ShadingFlags {
 public:
  explicit ShadingFlags(std::string method) : method_(std::move(method)) {}

  /// --method, --drawn-lights and --light-cut: of glints and of many lights.
  void addGlintOptions(Command& command);
  /// --geometric-aa, --normal-method, --ltc-method and --round-lobes.
  void addSurfaceOptions(Command& command);

  /// Throws Error, one sentence, for a name or number that there is not.
  void apply(ShadingOptions& options) const;
  /// One sentence for each option that was given and does nothing, or nothing for some material.
  /// `truth`: the ground truth is shaded, which has no methods.
  std::vector<std::string> idle(const Scene& scene, const ShadingOptions& options,
                                bool truth = false) const;
  /// Prints them on stderr.
  void noteIdle(const Scene& scene, const ShadingOptions& options, bool quiet,
                bool truth = false) const;

 private:
  struct Given {
    std::string name;
    CommandOption option;
  };
  void add(Command& command, const std::string& name, std::string& value, const std::string& help);
  bool isGiven(const std::string& name) const;

  std::string method_;
  std::string normal_method_ = choiceName(ShadingOptions{}.normal_method);
  std::string ltc_method_ = choiceName(ShadingOptions{}.ltc_method);
  std::string geometric_aa_ = choiceName(ShadingOptions{}.geometric_aa);
  std::string light_cut_ = choiceName(ShadingOptions{}.light_cut);
  int drawn_lights_ = 0;
  bool round_lobes_ = false;
  std::vector<Given> given_;
};

}  // namespace glintmark
