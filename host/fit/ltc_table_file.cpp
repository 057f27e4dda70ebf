// The files of LtcTable. Writing is serializeLtcTable plus whoever owns the file.
#include <fmt/format.h>

#include "host/fit/data_folder.h"
#include "host/fit/ltc_table.h"
#include "host/fit/table_file.h"

namespace glintmark {
namespace {

constexpr TableFormat kLtcFormat = {.magic = "GM-LTC\r\n",  // shows text conversion
                                    .name = "an LTC table",
                                    .command = "glintmark fit ltc",
                                    .version = 2,
                                    .cell_floats = LTC_CELL_FLOATS,
                                    .least_size = LTC_SIZE_MIN,
                                    .most_size = LTC_SIZE_MAX,
                                    .axes = 2};

}  // namespace

std::string serializeLtcTable(const LtcTable& table) {
  return serializeTable(kLtcFormat, table.ndf, table.size, table.values);
}

LtcTable parseLtcTable(std::string_view bytes, const std::string& name) {
  TableContent content = parseTable(kLtcFormat, bytes, name);
  LtcTable table(content.ndf, content.size);
  table.values = std::move(content.values);
  return table;
}

LtcTable loadLtcTable(const std::filesystem::path& path) {
  return parseLtcTable(readTableFile(kLtcFormat, path), path.string());
}

LtcTable shippedLtcTable(reference::Ndf ndf) {
  const std::filesystem::path path =
      findDataFile(fmt::format("ltc_{}.table", reference::ndfName(ndf)));
  LtcTable table = loadLtcTable(path);
  requireNdf(table.ndf, ndf, path);
  return table;
}

}  // namespace glintmark
