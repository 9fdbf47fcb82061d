#include "halfspace/study/precision/edge_report.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/study/precision/edge_measure.hpp"
#include "halfspace/study/precision/edge_subjects.hpp"

namespace halfspace::study {
namespace {

using nlohmann::ordered_json;

ordered_json rows(const std::vector<EdgeTally>& tallies) {
  ordered_json made;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const EdgeTally& tally = tallies[i];
    made[std::string(edge_subjects()[i].name)] = {
        {"wrong", tally.wrong}, {"moved", tally.moved}, {"gaps", tally.gaps}, {"doubles", tally.doubles}};
  }
  return made;
}

/// What all arithmetics were given; covered pixels are those before snapping, of the first.
ordered_json given(const std::vector<EdgeTally>& tallies) {
  const EdgeTally& first = tallies.front();
  return {{"triangles", first.triangles}, {"samples", first.samples}, {"pixels", first.pixels}};
}

void add(std::vector<EdgeTally>& sum, const std::vector<EdgeTally>& more) {
  sum.resize(more.size());
  for (std::size_t i = 0; i < more.size(); ++i) {
    sum[i] += more[i];
  }
}

ordered_json family_report(const EdgeFamily& family, std::uint64_t samples) {
  std::vector<EdgeTally> sum;
  for (std::uint64_t index = 0; sum.empty() || sum.front().samples < samples; ++index) {
    add(sum, measure_edges(family.draw(index)));
  }
  ordered_json made{{"name", family.name}, {"looks", family.looks}, {"partition", family.partition}};
  made.update(given(sum));
  made["rows"] = rows(sum);
  return made;
}

ordered_json frame_report(const std::filesystem::path& path) {
  std::vector<EdgeTally> sum;
  for (const Drawing& drawing : frame_drawings(path)) {
    add(sum, measure_edges(drawing));
  }
  const std::string file = path.filename().string();
  ordered_json made{{"name", file.substr(0, file.find('.'))}};
  made.update(given(sum));
  made["rows"] = rows(sum);
  return made;
}

ordered_json time_report(std::string looks, const std::vector<FloatTriangle>& triangles,
                         const PixelRect& target, int rounds) {
  ordered_json made{{"looks", std::move(looks)}, {"rounds", rounds}};
  const std::vector<EdgeTime> times = time_edges(triangles, target, rounds);
  for (std::size_t i = 0; i < times.size(); ++i) {
    made["rows"][std::string(edge_subjects()[i].name)] = {{"nanoseconds", times[i].nanoseconds},
                                                          {"ratio", times[i].ratio}};
  }
  return made;
}

ordered_json time_reports(std::uint64_t seed, int rounds) {
  const Drawing mesh = jittered_mesh(0, 128, 8, 0.25, seed);
  std::vector<FloatTriangle> small;
  for (const PlacedTriangle& placed : mesh.triangles) {
    small.push_back(placed.triangle);
  }
  SplitMix64 random(seed);
  std::vector<FloatTriangle> large(16);
  for (FloatTriangle& triangle : large) {
    for (auto& p : triangle) {
      p.x = static_cast<float>(random.real(0, 1024));
      p.y = static_cast<float>(random.real(0, 1024));
    }
  }
  return {time_report("a mesh of 32,768 triangles", small, mesh.target, rounds),
          time_report("16 triangles anywhere", large, mesh.target, rounds)};
}

}  // namespace

ordered_json edge_report(std::uint64_t samples, std::uint64_t seed, int rounds,
                         std::span<const std::filesystem::path> frames) {
  ordered_json made;
  for (const EdgeSubject& subject : edge_subjects()) {
    made["arithmetics"].push_back({{"name", subject.name},
                                   {"computes", subject.computes},
                                   {"source", subject.source},
                                   {"bits", subject.bits}});
  }
  for (const EdgeFamily& family : edge_families(seed)) {
    made["families"].push_back(family_report(family, samples));
  }
  made["frames"] = ordered_json::array();
  for (const std::filesystem::path& frame : frames) {
    made["frames"].push_back(frame_report(frame));
  }
  made["baseline"] = kBaseline;
  made["time"] = time_reports(seed, rounds);
  return made;
}

}  // namespace halfspace::study
