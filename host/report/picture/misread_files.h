// Image files that OpenImageIO takes for others without saying so.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace glintmark {

/// Bytes of a file's beginning that misreading() looks at.
inline constexpr std::size_t kMisreadHead_bytes = 1024;

/// Why the pixels that OpenImageIO 2.4 gives for a file that begins so would not be the file's:
/// luminance of DDS (black), bit masks of BMP (channels changed about), colour maps of TGA that do
/// not begin at 0, DPX of columns (rows of the wrong length). Empty if nothing is known against it.
/// `name` is the file's: TGA files have no mark of their own.
std::string misreading(std::string_view head, std::string_view name);

}  // namespace glintmark
