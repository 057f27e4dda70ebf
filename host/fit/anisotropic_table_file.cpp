// The files of AnisotropicTable. Writing is serializeAnisotropicTable plus whoever owns the file.
#include <fmt/format.h>

#include "host/fit/anisotropic_table.h"
#include "host/fit/data_folder.h"
#include "host/fit/table_file.h"

namespace glintmark {
namespace {

constexpr TableFormat kAnisotropicFormat = {.magic = "GM-ALT\r\n",
                                            .name = "an anisotropic LTC table",
                                            .command = "glintmark fit ltc --anisotropic",
                                            .version = 2,
                                            .cell_floats = ANISO_FLOATS,
                                            .least_size = ANISO_NODES,
                                            .most_size = ANISO_NODES,
                                            .axes = 4};

}  // namespace

std::string serializeAnisotropicTable(const AnisotropicTable& table) {
  return serializeTable(kAnisotropicFormat, table.ndf, ANISO_NODES, table.values);
}

AnisotropicTable parseAnisotropicTable(std::string_view bytes, const std::string& name) {
  TableContent content = parseTable(kAnisotropicFormat, bytes, name);
  return {content.ndf, std::move(content.values)};
}

AnisotropicTable loadAnisotropicTable(const std::filesystem::path& path) {
  return parseAnisotropicTable(readTableFile(kAnisotropicFormat, path), path.string());
}

AnisotropicTable shippedAnisotropicTable(reference::Ndf ndf) {
  const std::filesystem::path path =
      findDataFile(fmt::format("ltc_anisotropic_{}.table", reference::ndfName(ndf)));
  AnisotropicTable table = loadAnisotropicTable(path);
  requireNdf(table.ndf, ndf, path);
  return table;
}

}  // namespace glintmark
