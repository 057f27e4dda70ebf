// Models of lobes that a material may have, with their names.
#pragma once

namespace glintmark {

/// Diffuse lobe: Lambert's, or a rough surface that light leaves after several bounces, [PAT18]
/// with its own coefficients or ours, energy-preserving Oren-Nayar, or a model of ours fitted to
/// single scattering and to all of it.
enum class DiffuseModel : int { kLambert, kPublished, kRefit, kEon, kFitted };

/// What a specular lobe gets back of the light that it loses to further bounces: nothing; scaled,
/// what it lacks itself, so that a white furnace stays white, or of that what the simulated
/// surfaces lack, or the first in the colour of the mean reflectance; or a lobe beside it, Kulla
/// and Conty's or Fdez-Aguera's.
enum class Compensation : int { kOff, kLobe, kSimulated, kMean, kKullaConty, kFdezAguera };

/// A model and what scene files, records and tables call it.
template <typename Model>
struct NamedModel {
  const char* name;
  Model model;
};

inline constexpr NamedModel<DiffuseModel> kDiffuseModels[] = {
    {"lambert", DiffuseModel::kLambert},
    {"published", DiffuseModel::kPublished},
    {"refit", DiffuseModel::kRefit},
    {"eon", DiffuseModel::kEon},
    {"fitted", DiffuseModel::kFitted}};
inline constexpr NamedModel<Compensation> kCompensations[] = {
    {"off", Compensation::kOff},
    {"lobe", Compensation::kLobe},
    {"simulated", Compensation::kSimulated},
    {"mean", Compensation::kMean},
    {"kulla_conty", Compensation::kKullaConty},
    {"fdez_aguera", Compensation::kFdezAguera}};

}  // namespace glintmark
