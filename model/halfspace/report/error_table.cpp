#include "halfspace/report/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace halfspace {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kRtl = "rtl";

std::int64_t difference(std::uint64_t value, std::uint64_t truth) {
  return static_cast<std::int64_t>(value - truth);
}

std::uint64_t magnitude(std::int64_t value) {
  return value < 0 ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
}

// Comparison.

StageError compare_stage(const StageInfo& info, const StageCycles& cycles, const StageCycles& truth) {
  StageError error;
  const auto add = [&error](std::string_view name, std::uint64_t value, std::uint64_t expected) {
    const std::int64_t off = difference(value, expected);
    error.off += magnitude(off);
    if (magnitude(off) > magnitude(error.largest_cycles)) {
      error.largest = name;
      error.largest_cycles = off;
    }
  };
  add("busy", cycles.busy, truth.busy);
  for (std::size_t i = 0; i < kMostStallReasons; ++i) {
    add(info.stall[i], cycles.stall[i], truth.stall[i]);
  }
  return error;
}

/// Cycles of each draw.
std::vector<std::uint64_t> spans(const FrameCycles& frame) {
  std::vector<std::uint64_t> cycles;
  std::uint64_t before = 0;
  for (const DrawCycles& draw : frame.draws) {
    cycles.push_back(draw.end - before);
    before = draw.end;
  }
  return cycles;
}

DrawErrors compare_draws(const std::vector<std::uint64_t>& draws, const std::vector<std::uint64_t>& truth) {
  DrawErrors errors{.draws = truth.size()};
  for (std::size_t i = 0; i < std::max(draws.size(), truth.size()); ++i) {
    const CycleError error{
        .truth = i < truth.size() ? truth[i] : 0,
        .cycles = difference(i < draws.size() ? draws[i] : 0, i < truth.size() ? truth[i] : 0)};
    errors.off += error.cycles != 0 || i >= draws.size() || i >= truth.size() ? 1 : 0;
    errors.cycles_off += magnitude(error.cycles);
    if (error.truth < DrawErrors::kLong) {
      continue;
    }
    if (errors.long_draws++ == 0 || std::abs(error.percent()) > std::abs(errors.worst_percent)) {
      errors.worst_draw = i;
      errors.worst_percent = error.percent();
    }
    errors.mean_percent += error.percent();
    errors.mean_magnitude_percent += std::abs(error.percent());
  }
  if (errors.long_draws != 0) {
    errors.mean_percent /= static_cast<double>(errors.long_draws);
    errors.mean_magnitude_percent /= static_cast<double>(errors.long_draws);
  }
  return errors;
}

template <class Value>
std::uint64_t count_different(const TiledImage<Value>& image, const TiledImage<Value>& truth) {
  if (image.width() != truth.width() || image.height() != truth.height()) {
    return std::max(std::uint64_t{1},
                    static_cast<std::uint64_t>(truth.width()) * static_cast<std::uint64_t>(truth.height()));
  }
  std::uint64_t count = 0;
  for (int y = 0; y < truth.height(); ++y) {
    for (int x = 0; x < truth.width(); ++x) {
      count += image.at(x, y) != truth.at(x, y) ? 1 : 0;
    }
  }
  return count;
}

std::uint64_t count_different(const Counters& counters, const Counters& truth) {
  std::uint64_t count = 0;
  Counters::units([&](const char* /*name*/, auto unit) {
    using Unit = std::remove_cvref_t<decltype(counters.*unit)>;
    Unit::fields([&](const char* /*name*/, const char* /*help*/, auto member) {
      count += counters.*unit.*member != truth.*unit.*member ? 1 : 0;
    });
  });
  return count;
}

FunctionErrors compare_function(const FrameResult& result, const FrameResult& truth) {
  FunctionErrors errors;
  errors.counters = count_different(result.counters, truth.counters) +
                    count_different(result.drawn_clears, truth.drawn_clears) +
                    (result.clears != truth.clears ? 1 : 0) +
                    (result.flushed_lines != truth.flushed_lines ? 1 : 0) +
                    (result.flushed_bytes != truth.flushed_bytes ? 1 : 0) +
                    (result.draws_not_filled != truth.draws_not_filled ? 1 : 0);
  const DrawStats no_draw;
  for (std::size_t i = 0; i < std::max(result.draws.size(), truth.draws.size()); ++i) {
    const DrawStats& draw = i < result.draws.size() ? result.draws[i] : no_draw;
    const DrawStats& expected = i < truth.draws.size() ? truth.draws[i] : no_draw;
    errors.counters += count_different(draw.counters, expected.counters) +
                       (draw.command != expected.command ? 1 : 0) +
                       (draw.surface != expected.surface ? 1 : 0);
  }
  const Surface no_surface;
  for (std::size_t i = 0; i < std::max(result.surfaces.size(), truth.surfaces.size()); ++i) {
    const Surface& surface = i < result.surfaces.size() ? result.surfaces[i] : no_surface;
    const Surface& expected = i < truth.surfaces.size() ? truth.surfaces[i] : no_surface;
    errors.codes += count_different(surface.codes, expected.codes);
    errors.fragments += count_different(surface.fragments, expected.fragments);
    errors.survivors += count_different(surface.survivors, expected.survivors);
    errors.counters += count_different(surface.counters, expected.counters);
  }
  return errors;
}

// Presentation.

constexpr std::string_view kNone = "-";

/// Three digits or so.
std::string short_number(double value) {
  const double size = std::abs(value);
  return size < 10    ? fmt::format("{:.2f}", value)
         : size < 100 ? fmt::format("{:.1f}", value)
                      : fmt::format("{:.0f}", value);
}

std::string signed_cycles(std::int64_t cycles) { return cycles == 0 ? "0" : fmt::format("{:+}", cycles); }

/// An error that is not 0 never looks like 0.
std::string signed_percent(double percent) {
  if (percent == 0) {
    return "0";
  }
  return std::abs(percent) < 0.01 ? fmt::format("{:+.1e}", percent) : fmt::format("{:+.2f}", percent);
}

std::string unsigned_percent(double percent) {
  const std::string text = signed_percent(percent);
  return text[0] == '+' ? text.substr(1) : text;
}

std::uint64_t cycles_off(const std::array<StageError, kStages>& stages) {
  std::uint64_t sum = 0;
  for (const StageError& stage : stages) {
    sum += stage.off;
  }
  return sum;
}

/// "early_z fill +12".
std::string largest(const std::array<StageError, kStages>& stages) {
  const auto at = std::ranges::max_element(
      stages, {}, [](const StageError& stage) { return magnitude(stage.largest_cycles); });
  return at->largest.empty()
             ? std::string(kNone)
             : fmt::format("{} {} {:+}", kStageInfo[static_cast<std::size_t>(at - stages.begin())].name,
                           at->largest, at->largest_cycles);
}

/// A fidelity over all workloads.
struct Summary {
  std::string fidelity;
  double milliseconds = 0;
  double rtl_milliseconds = 0;  ///< for the same workloads
  double magnitudes = 0;        ///< sum of the errors' in percent
  double worst_percent = 0;
  std::string worst_workload;
  std::size_t timed = 0;  ///< workloads with cycles
  std::size_t draws = 0;
  std::size_t draws_off = 0;
  std::uint64_t rtl_cycles = 0;
  std::optional<std::uint64_t> stages_off;
  std::optional<std::uint64_t> function;
};

void add(Summary& summary, const WorkloadErrors& workload, const FidelityError& line,
         const FidelityError& rtl) {
  summary.milliseconds += line.median_milliseconds();
  summary.rtl_milliseconds += rtl.median_milliseconds();
  summary.rtl_cycles += rtl.cycles.value_or(0);
  if (line.error) {
    const double percent = line.error->percent();
    if (summary.timed++ == 0 || std::abs(percent) > std::abs(summary.worst_percent)) {
      summary.worst_percent = percent;
      summary.worst_workload = workload.name;
    }
    summary.magnitudes += std::abs(percent);
  }
  if (line.draws) {
    summary.draws += line.draws->draws;
    summary.draws_off += line.draws->off;
  }
  if (line.stages) {
    summary.stages_off = summary.stages_off.value_or(0) + cycles_off(*line.stages);
  }
  if (line.function) {
    summary.function = summary.function.value_or(0) + line.function->total();
  }
}

const FidelityError& rtl_line(const WorkloadErrors& workload) {
  return *std::ranges::find(workload.fidelities, kRtl, &FidelityError::fidelity);
}

/// In the order of the first workload, which all have.
std::vector<Summary> summaries(const ErrorTable& table) {
  std::vector<Summary> all;
  for (const WorkloadErrors& workload : table.workloads) {
    for (const FidelityError& line : workload.fidelities) {
      auto at = std::ranges::find(all, line.fidelity, &Summary::fidelity);
      if (at == all.end()) {
        at = all.insert(all.end(), Summary{});
        at->fidelity = line.fidelity;
      }
      add(*at, workload, line, rtl_line(workload));
    }
  }
  return all;
}

std::string summary_markdown(const ErrorTable& table) {
  std::string text =
      "| fidelity | Mcycles/s | times faster than rtl | mean error's magnitude % | worst error % | draws off "
      "| "
      "stages off, cycles | function differs |\n"
      "|---|---:|---:|---:|---|---:|---:|---:|\n";
  for (const Summary& s : summaries(table)) {
    const bool timed = s.timed != 0;
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n", s.fidelity,
        timed || s.fidelity == kRtl ? short_number(static_cast<double>(s.rtl_cycles) / s.milliseconds / 1e3)
                                    : kNone,
        s.fidelity == kRtl ? std::string(kNone) : short_number(s.rtl_milliseconds / s.milliseconds),
        timed ? unsigned_percent(s.magnitudes / static_cast<double>(s.timed)) : kNone,
        !timed                 ? std::string(kNone)
        : s.worst_percent == 0 ? "0"
                               : fmt::format("{} ({})", signed_percent(s.worst_percent), s.worst_workload),
        s.stages_off ? fmt::format("{} of {}", s.draws_off, s.draws) : kNone,
        s.stages_off ? std::to_string(*s.stages_off) : kNone,
        s.function ? std::to_string(*s.function) : kNone);
  }
  return text;
}

std::string workload_markdown(const WorkloadErrors& workload) {
  std::string text;
  for (const FidelityError& line : workload.fidelities) {
    const auto speed = line.megacycles_a_second();
    const bool percentages = line.draws && line.draws->long_draws != 0;
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", workload.name,
        line.fidelity, short_number(line.median_milliseconds()),
        line.cycles ? std::to_string(*line.cycles) : kNone, speed ? short_number(*speed) : kNone,
        line.error ? signed_cycles(line.error->cycles) : kNone,
        line.error ? signed_percent(line.error->percent()) : kNone,
        line.draws ? fmt::format("{} of {}", line.draws->off, line.draws->draws) : kNone,
        percentages ? signed_percent(line.draws->mean_percent) : kNone,
        percentages ? unsigned_percent(line.draws->mean_magnitude_percent) : kNone,
        !percentages ? std::string(kNone)
        : line.draws->worst_percent == 0
            ? "0"
            : fmt::format("{} (draw {})", signed_percent(line.draws->worst_percent), line.draws->worst_draw),
        line.stages ? std::to_string(cycles_off(*line.stages)) : kNone,
        line.stages ? largest(*line.stages) : kNone,
        line.function ? std::to_string(line.function->total()) : kNone,
        line.packets ? fmt::format("{} of {}", line.packets->different, line.packets->compared) : kNone);
  }
  return text;
}

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json line_json(const FidelityError& line) {
  Json json{{"fidelity", line.fidelity},
            {"milliseconds", line.median_milliseconds()},
            {"runs", line.milliseconds},
            {"cycles", json_or_null(line.cycles)},
            {"megacycles_per_second", json_or_null(line.megacycles_a_second())}};
  json["error"] =
      line.error ? Json{{"cycles", line.error->cycles}, {"percent", line.error->percent()}} : Json();
  json["draws"] = Json();
  if (const auto& draws = line.draws) {
    const bool any = draws->long_draws != 0;
    json["draws"] = {{"draws", draws->draws},
                     {"off", draws->off},
                     {"cycles_off", draws->cycles_off},
                     {"long_draws", draws->long_draws},
                     {"mean_percent", any ? Json(draws->mean_percent) : Json()},
                     {"mean_magnitude_percent", any ? Json(draws->mean_magnitude_percent) : Json()},
                     {"worst_draw", any ? Json(draws->worst_draw) : Json()},
                     {"worst_percent", any ? Json(draws->worst_percent) : Json()}};
  }
  json["stages"] = Json();
  for (std::size_t i = 0; line.stages && i < kStages; ++i) {
    const StageError& stage = (*line.stages)[i];
    json["stages"][std::string(kStageInfo[i].name)] = {
        {"cycles_off", stage.off},
        {"largest", stage.largest.empty() ? Json() : Json(stage.largest)},
        {"largest_cycles", stage.largest_cycles}};
  }
  json["function"] = line.function ? Json{{"codes", line.function->codes},
                                          {"fragments", line.function->fragments},
                                          {"survivors", line.function->survivors},
                                          {"counters", line.function->counters}}
                                   : Json();
  json["packets"] = line.packets
                        ? Json{{"compared", line.packets->compared}, {"different", line.packets->different}}
                        : Json();
  return json;
}

/// A column of error.csv: its name, and where its value is in a line's JSON.
struct CsvColumn {
  std::string name;
  Json::json_pointer value;
  int decimals = -1;  ///< of a number; -1: as many as it needs
};

std::vector<CsvColumn> csv_columns() {
  std::vector<CsvColumn> columns;
  const auto add = [&](const std::string& name, const std::string& value, int decimals = -1) {
    columns.push_back({name, Json::json_pointer(value), decimals});
  };
  add("fidelity", "/fidelity");
  add("runs", "/runs");
  add("milliseconds", "/milliseconds", 4);
  add("cycles", "/cycles");
  add("megacycles_per_second", "/megacycles_per_second");
  add("error_cycles", "/error/cycles");
  add("error_percent", "/error/percent");
  add("draws", "/draws/draws");
  add("draws_off", "/draws/off");
  add("draws_cycles_off", "/draws/cycles_off");
  add("long_draws", "/draws/long_draws");
  add("draws_mean_percent", "/draws/mean_percent");
  add("draws_mean_magnitude_percent", "/draws/mean_magnitude_percent");
  add("worst_draw", "/draws/worst_draw");
  add("worst_draw_percent", "/draws/worst_percent");
  for (const StageInfo& stage : kStageInfo) {
    const std::string name(stage.name);
    add(name + "_off", "/stages/" + name + "/cycles_off");
    add(name + "_largest", "/stages/" + name + "/largest");
    add(name + "_largest_cycles", "/stages/" + name + "/largest_cycles");
  }
  for (const std::string name : {"codes", "fragments", "survivors", "counters"}) {
    add(name + "_different", "/function/" + name);
  }
  add("packets_compared", "/packets/compared");
  add("packets_different", "/packets/different");
  return columns;
}

/// Empty where the line has no such value.
std::string csv_cell(const Json& line, const CsvColumn& column) {
  const Json value = line.contains(column.value) ? line[column.value] : Json();
  if (value.is_null()) {
    return {};
  }
  if (value.is_array()) {
    return std::to_string(value.size());  // runs
  }
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (!value.is_number_float()) {
    return value.dump();
  }
  const auto number = value.get<double>();
  return column.decimals < 0 ? fmt::format("{}", number) : fmt::format("{:.{}f}", number, column.decimals);
}

Json to_json(const ErrorTable& table, const std::vector<std::string>& files) {
  Json json;
  json["schema"] = kErrorSchema;
  json["schema_version"] = kErrorSchemaVersion;
  json["tool"] = {{"name", "halfspace"}, {"version", HALFSPACE_VERSION}, {"compiler", __VERSION__}};
  json["truth"] = kRtl;
  json["repeat"] = table.repeat;
  json["long_draw_cycles"] = DrawErrors::kLong;
  for (const ConfigKey& key : config_keys(table.config)) {
    json["config"][key.name] = key.value;
  }
  json["config_hash"] = config_hash(table.config);
  json["workloads"] = Json::array();
  for (const WorkloadErrors& workload : table.workloads) {
    Json& entry = json["workloads"].emplace_back();
    entry = {{"name", workload.name}, {"triangles", workload.triangles}, {"fragments", workload.fragments}};
    for (const FidelityError& line : workload.fidelities) {
      entry["fidelities"].push_back(line_json(line));
    }
  }
  json["files"] = files;
  return json;
}

}  // namespace

double CycleError::percent() const {
  return 100.0 * static_cast<double>(cycles) / static_cast<double>(std::max<std::uint64_t>(truth, 1));
}

double FidelityError::median_milliseconds() const {
  std::vector<double> sorted = milliseconds;
  std::ranges::sort(sorted);
  return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
}

std::optional<double> FidelityError::megacycles_a_second() const {
  return cycles ? std::optional(static_cast<double>(*cycles) / median_milliseconds() / 1e3) : std::nullopt;
}

FidelityError compare_to_rtl(const FidelityRun& run, const FidelityRun& rtl) {
  FidelityError line;
  line.fidelity = run.fidelity;
  line.milliseconds = run.milliseconds;
  line.packets = run.rtl;
  line.cycles = run.cycles ? run.cycles->cycles : run.record_cycles;
  if (&run == &rtl) {
    return line;
  }
  const FrameCycles& truth = rtl.cycles.value();
  if (line.cycles) {
    line.error = {.truth = truth.cycles, .cycles = difference(*line.cycles, truth.cycles)};
  }
  if (run.record_cycles) {
    return line;
  }
  line.function = compare_function(run.frame, rtl.frame);
  if (run.cycles) {
    line.draws = compare_draws(spans(*run.cycles), spans(truth));
    line.stages.emplace();
    for (std::size_t i = 0; i < kStages; ++i) {
      (*line.stages)[i] = compare_stage(kStageInfo[i], run.cycles->stats.stage[i], truth.stats.stage[i]);
    }
  }
  return line;
}

WorkloadErrors compare_fidelities(const std::string& name, const std::vector<FidelityRun>& runs) {
  const auto rtl = std::ranges::find(runs, kRtl, &FidelityRun::fidelity);
  if (rtl == runs.end()) {
    throw std::invalid_argument(fmt::format("{}: no run of fidelity {} to compare with", name, kRtl));
  }
  WorkloadErrors workload{.name = name,
                          .triangles = rtl->frame.counters.front_end.triangles,
                          .fragments = rtl->frame.counters.quad_generator.fragments,
                          .fidelities = {}};
  for (const FidelityRun& run : runs) {
    workload.fidelities.push_back(compare_to_rtl(run, *rtl));
  }
  return workload;
}

bool ErrorTable::function_agrees() const {
  return std::ranges::all_of(workloads, [](const WorkloadErrors& workload) {
    return std::ranges::all_of(workload.fidelities, [](const FidelityError& line) {
      return (!line.function || line.function->total() == 0) &&
             (!line.packets || line.packets->different == 0);
    });
  });
}

std::string error_markdown(const ErrorTable& table) {
  std::string text = fmt::format(
      "One thread; medians of {} runs in turns, rtl fewer where they take seconds. Errors are against rtl; "
      "configuration {}.\n\n{}\n"
      "| workload | fidelity | ms | cycles | Mcycles/s | error, cycles | error % | draws off | draws' mean % "
      "| "
      "magnitude % | worst % | stages off, cycles | most | function differs | packets differ |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---|---:|---|---:|---:|\n",
      table.repeat, config_hash(table.config), summary_markdown(table));
  for (const WorkloadErrors& workload : table.workloads) {
    text += workload_markdown(workload);
  }
  return text;
}

std::string error_csv(const ErrorTable& table) {
  const std::vector<CsvColumn> columns = csv_columns();
  std::string text = "workload";
  for (const CsvColumn& column : columns) {
    text += "," + column.name;
  }
  text += '\n';
  for (const WorkloadErrors& workload : table.workloads) {
    for (const FidelityError& line : workload.fidelities) {
      const Json json = line_json(line);
      text += workload.name;
      for (const CsvColumn& column : columns) {
        text += "," + csv_cell(json, column);
      }
      text += '\n';
    }
  }
  return text;
}

void write_error_files(OutputFolder& folder, const ErrorTable& table) {
  folder.write("error.md", error_markdown(table));
  folder.write("error.csv", error_csv(table));
  std::vector<std::string> files = folder.files();
  files.emplace_back(kErrorFile);
  folder.write(kErrorFile, to_json(table, files).dump(1) + '\n');
}

}  // namespace halfspace
