// Table `effects` on the page.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// The matrix of pairs, and what each set needs.
std::string effectsHtml(std::span<const Record> records);

}  // namespace glintmark
