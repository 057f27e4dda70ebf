// Errors, biases and times of an effect's settings in each scene, below its table.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// Of cases "EFFECT/SCENE/VIEW/knob=value": three tables of settings over scenes (error, bias, time
/// over the default's), at most kTableColumnsLimit columns, and what sampled rivals take for the
/// default's error from scene to scene; empty if there are none.
std::string accuracySceneText(std::span<const Record> records, const std::string& effect);

}  // namespace glintmark
