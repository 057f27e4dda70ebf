// The tables' texts: columns, what is not valid, what they show.
#include <gtest/gtest.h>

#include "host/experiment/effects/effects_table.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/report/record/text_table.h"
#include "tests/report/sample_records.h"
#include "tests/report/widest_line.h"

namespace glintmark {
namespace {

// Records of all ten views with `scale` times plausible values.
std::vector<Record> tenViews(double scale) {
  std::vector<Record> records;
  for (const Zk16PaperRow& row : kZk16Table1) {
    for (const std::string_view view : kZk16Views) {
      const std::string name = std::string(row.scene) + "/" + std::string(view);
      for (const char* metric :
           {"shading_ms", "normalised_cost", "ns_per_cell", "speedup_vs_w1", "cells_mean",
            "raster_ms", "upload_ms", "readback_ms", "build_ms", "first_enqueue_ms",
            "frame_with_ms", "frame_without_ms", "shading_event_ms", "buffer_bytes_per_px"}) {
        records.push_back(sampleRecord(name, metric, 41.2345 * scale));
      }
      records.push_back(sampleRecord(name, "triangles", 570000));
      records.push_back(sampleRecord(name, "covered_px", 2073600));
      records.push_back(sampleRecord(name, "glint_share", 1));
      records.push_back(sampleRecord(name, "cells_min", 8));
      records.push_back(sampleRecord(name, "cells_max", 64));
      records.push_back(sampleRecord(name, "guard_hits", 2073600));
      for (Record& record : records) {
        if (record.metric == "shading_ms") record.paper = row.steep_ms;
      }
    }
  }
  return records;
}

TEST(Zk16Table, FitsHundredColumnsForPlausibleAndExtremeValues) {
  for (const double scale : {1e-3, 1.0, 100.0}) {
    const std::vector<Record> records = tenViews(scale);
    EXPECT_LE(widestLine(zk16TableText(records)), 100u);
    EXPECT_LE(widestLine(zk16BreakdownText(records)), 100u);
  }
}

TEST(Zk16Table, ShowsPaperOursAndRatio) {
  std::vector<Record> records = {sampleRecord("snow/steep", "shading_ms", 50)};
  records[0].paper = 2.5;
  records.push_back(sampleRecord("snow/steep", "triangles", 32000));
  records.push_back(sampleRecord("snow/steep", "cells_mean", 8.4));
  records.back().valid = false;
  const std::string text = zk16TableText(records);
  EXPECT_NE(text.find("32000"), std::string::npos) << text;
  EXPECT_NE(text.find(" 2.5 "), std::string::npos) << text;
  EXPECT_NE(text.find(" 50.0 "), std::string::npos) << text;
  EXPECT_NE(text.find(" 20.0 "), std::string::npos) << text;  // 50 / 2.5
  EXPECT_NE(text.find("-/8.40!/-"), std::string::npos) << text;
}

TEST(Zk16Table, PaperFigures) {
  EXPECT_EQ(zk16PaperMs("screen_plane", "steep"), 0.9);
  EXPECT_EQ(zk16PaperMs("sponza", "grazing"), 5.9);
  EXPECT_EQ(zk16PaperMs("sponza", "other"), std::nullopt);
  EXPECT_EQ(zk16PaperMs("sand", "steep"), std::nullopt);
}

TEST(Zk16Table, NormalisedCostIsOneForThePapersGpu) {
  EXPECT_DOUBLE_EQ(normalisedCost(2.9, kGtx980PeakGflops, 2.9, kGtx980PeakGflops), 1);
  // The prototype's plane: 41 ms at 450 GFLOP/s against 0.9 ms.
  EXPECT_NEAR(normalisedCost(41, 450, 0.9, kGtx980PeakGflops), 4.1, 0.05);
}

TEST(MsbrdfTable, FitsHundredColumnsAndMarksWhatIsNotValid) {
  std::vector<Record> records;
  const auto add = [&](const std::string& name, std::initializer_list<const char*> metrics) {
    for (const char* metric : metrics) records.push_back(sampleRecord(name, metric, 0.123456));
  };
  add("surface/alpha=0.24", {"rays_per_s", "order_1", "order_2", "order_6"});
  add("model/alpha=0.24", {"lobe_error", "lobe_error_published", "lobe_error_eon", "furnace"});
  add("energy/alpha=0.24/theta=60", {"order_1", "order_1_eon", "order_2_refit", "order_3"});
  add("metal/alpha=0.24", {"furnace_before", "furnace_after"});
  add("all", {"runtime_ms", "lambert_ms", "simulate_500m_ms", "normalised_cost"});
  records.back().valid = false;
  const std::string text = msbrdfTableText(records);
  EXPECT_LE(widestLine(text), kTableColumnsLimit);
  EXPECT_NE(text.find("normalised cost 0.12!"), std::string::npos) << text;
  EXPECT_NE(text.find("alpha=0.24/theta=60"), std::string::npos);
  EXPECT_NE(text.find("about 500 ms"), std::string::npos);
}

// Records of a set of effects: `scale` times plausible times and sizes, and plausible ratios.
std::vector<Record> effectsCase(const std::string& name, double scale) {
  std::vector<Record> records;
  for (const char* metric : {"uber_over_specialised", "full_screen_over_lists", "mixed_over_sum",
                             "mixed_over_sum_worst"})
    records.push_back(sampleRecord(name, metric, 1.2345));
  for (const char* metric : {"shading_ms", "build_ms", "uber_build_ms"})
    records.push_back(sampleRecord(name, metric, 1.2345 * scale));
  for (const char* metric : {"planes_bytes", "tables_bytes"})
    records.push_back(sampleRecord(name, metric, 1.2345e6 * scale));
  return records;
}

TEST(EffectsTable, FitsHundredColumnsWithWholeNames) {
  const std::string longest = "normals+ltc+multiscale+compensation";
  for (const double scale : {1e-3, 1.0, 1e4}) {
    std::vector<Record> records = effectsCase(longest, scale);
    for (const Record& record : effectsCase("all", scale)) records.push_back(record);
    const std::string text = effectsTableText(records);
    EXPECT_LE(widestLine(text), 100u) << text;
    EXPECT_NE(text.find(longest), std::string::npos) << text;
  }
}

TEST(EffectsTable, SaysWhatItShows) {
  std::vector<Record> records = {sampleRecord("none", "uber_over_specialised", 2.25),
                                 sampleRecord("all", "uber_over_specialised", 1.5),
                                 sampleRecord("all", "mixed_over_sum", 1.04)};
  const std::string text = effectsTableText(records);
  EXPECT_NE(text.find("takes 1.50 to 2.25 times as long"), std::string::npos) << text;
  EXPECT_NE(text.find("cost 1.04 of the sum"), std::string::npos) << text;
  EXPECT_EQ(effectsTableText({}).find("times as long"), std::string::npos);
}

TEST(EffectsTable, MatrixHasASquareForEveryPair) {
  std::vector<Record> records;
  for (const char* name : {"none", "glints", "ltc", "glints+ltc", "all"})
    records.push_back(sampleRecord(name, "uber_over_specialised", 2));
  const Image two = effectsMatrixPicture(records);
  records.push_back(sampleRecord("environment", "uber_over_specialised", 2));
  EXPECT_GT(effectsMatrixPicture(records).height, two.height);
}

}  // namespace
}  // namespace glintmark
