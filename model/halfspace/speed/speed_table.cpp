#include "halfspace/speed/speed_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace halfspace {
namespace {

using Json = nlohmann::ordered_json;

/// Three digits or so.
std::string digits(double value) {
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size < 10 ? 2 : size < 100 ? 1 : 0);
}

std::string cell(const Spread& s) {
  return fmt::format("{} ({} to {})", digits(s.median), digits(s.least), digits(s.most));
}

std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// Of the first contender, which is the one whose quads and triangles are counted.
double quads_a_microsecond(const SpeedRow& row) {
  return static_cast<double>(row.quads) / spread(row.runs[0].milliseconds).median / 1e3;
}

double nanoseconds_a_triangle(const SpeedRow& row) {
  return spread(row.runs[0].milliseconds).median * 1e6 /
         static_cast<double>(std::max<std::uint64_t>(row.triangles, 1));
}

/// Calls visit(ours, yardstick) for each pair that is compared.
template <class Visit>
void for_each_pair(const SpeedTable& table, Visit&& visit) {
  const std::vector<Contender>& all = table.contenders;
  for (std::size_t ours = 0; ours < all.size(); ++ours) {
    for (std::size_t other = 0; other < all.size(); ++other) {
      if (!all[ours].yardstick && all[other].yardstick && !all[ours].absent && !all[other].absent) {
        visit(ours, other);
      }
    }
  }
}

std::string markdown_row(const SpeedTable& table, const SpeedRow& row) {
  std::string text = fmt::format("| {} | {} | {} | {} | {} |", row.name, name(row.depth), row.triangles,
                                 row.fragments, row.runs[0].survivors);
  for (std::size_t i = 0; i < table.contenders.size(); ++i) {
    if (!table.contenders[i].absent) {
      text += fmt::format(" {} |", cell(spread(row.runs[i].milliseconds)));
    }
  }
  for_each_pair(table, [&](std::size_t ours, std::size_t other) {
    text += fmt::format(" {} |", cell(table.times_as_fast(row, ours, other)));
  });
  text += fmt::format(" {} | {} |", digits(quads_a_microsecond(row)), digits(nanoseconds_a_triangle(row)));
  for (std::size_t i = 1; i < table.contenders.size(); ++i) {
    if (!table.contenders[i].absent) {
      const auto off = static_cast<std::int64_t>(row.runs[i].survivors - row.runs[0].survivors);
      text += off == 0 ? " 0 |" : fmt::format(" {:+} |", off);
    }
  }
  return text + "\n";
}

}  // namespace

Spread spread(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return {.median = (numbers[(numbers.size() - 1) / 2] + numbers[numbers.size() / 2]) / 2,
          .least = numbers.front(),
          .most = numbers.back()};
}

Spread SpeedTable::times_as_fast(const SpeedRow& row, std::size_t ours, std::size_t yardstick) const {
  std::vector<double> ratios;
  for (std::size_t pass = 0; pass < row.runs[ours].milliseconds.size(); ++pass) {
    ratios.push_back(row.runs[yardstick].milliseconds[pass] / row.runs[ours].milliseconds[pass]);
  }
  return spread(ratios);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string threads_text(int threads) {
  return threads == 1 ? "one thread" : fmt::format("{} threads", threads);
}

std::string speed_markdown(const SpeedTable& table) {
  std::string text = fmt::format("{}, medians of {} passes in turns (least to most), ms",
                                 threads_text(table.threads), table.repeat);
  std::string head = "| workload | depth | triangles | fragments | survivors |";
  std::string rule = "|---|---|---:|---:|---:|";
  const auto column = [&](const std::string& name) {
    head += fmt::format(" {} |", name);
    rule += "---:|";
  };
  for (const Contender& contender : table.contenders) {
    text += fmt::format("; {}{}: {}", words(contender.name), contender.absent ? " is left out" : "",
                        contender.about);
    if (!contender.absent) {
      column(words(contender.name));
    }
  }
  for_each_pair(table, [&](std::size_t ours, std::size_t other) {
    column(fmt::format("{} / {}", words(table.contenders[other].name), words(table.contenders[ours].name)));
  });
  column("Mquads/s");
  column("ns a triangle");
  for (std::size_t i = 1; i < table.contenders.size(); ++i) {
    if (!table.contenders[i].absent) {
      column("survivors of " + words(table.contenders[i].name));
    }
  }
  text += "\n\n" + head + "\n" + rule + "\n";
  for (const SpeedRow& row : table.rows) {
    text += markdown_row(table, row);
  }
  return text;
}

std::string speed_csv(const SpeedTable& table) {
  std::string text = "workload,depth,triangles,fragments,quads";
  for (const Contender& c : table.contenders) {
    text += fmt::format(",{0}_survivors,{0}_ms,{0}_ms_least,{0}_ms_most", c.name);
  }
  for_each_pair(table, [&](std::size_t ours, std::size_t other) {
    text += fmt::format(",{0},{0}_least,{0}_most",
                        table.contenders[other].name + "_by_" + table.contenders[ours].name);
  });
  text += ",mquads_per_second,ns_per_triangle\n";
  for (const SpeedRow& row : table.rows) {
    text += fmt::format("{},{},{},{},{}", row.name, name(row.depth), row.triangles, row.fragments, row.quads);
    const auto add = [&](const Spread& s) {
      text += fmt::format(",{:.4f},{:.4f},{:.4f}", s.median, s.least, s.most);
    };
    for (std::size_t i = 0; i < table.contenders.size(); ++i) {
      if (table.contenders[i].absent) {
        text += ",,,,";
        continue;
      }
      text += fmt::format(",{}", row.runs[i].survivors);
      add(spread(row.runs[i].milliseconds));
    }
    for_each_pair(table,
                  [&](std::size_t ours, std::size_t other) { add(table.times_as_fast(row, ours, other)); });
    text += fmt::format(",{:.3f},{:.2f}\n", quads_a_microsecond(row), nanoseconds_a_triangle(row));
  }
  return text;
}

std::string speed_json(const SpeedTable& table) {
  Json json{{"schema", kSpeedSchema}, {"schema_version", kSpeedSchemaVersion}};
  json["tool"] = {{"name", "halfspace"}, {"version", HALFSPACE_VERSION}, {"compiler", __VERSION__}};
  json["processor"] = processor_name();
  json["config_hash"] = config_hash(table.config);
  json["repeat"] = table.repeat;
  json["threads"] = table.threads;
  for (const Contender& c : table.contenders) {
    json["contenders"].push_back(
        {{"name", c.name}, {"yardstick", c.yardstick}, {"absent", c.absent}, {"about", c.about}});
  }
  json["workloads"] = Json::array();
  for (const SpeedRow& row : table.rows) {
    Json& entry = json["workloads"].emplace_back(Json{{"name", row.name},
                                                      {"depth", name(row.depth)},
                                                      {"triangles", row.triangles},
                                                      {"fragments", row.fragments},
                                                      {"quads", row.quads}});
    for (std::size_t i = 0; i < table.contenders.size(); ++i) {
      if (!table.contenders[i].absent) {
        entry["runs"][table.contenders[i].name] = {{"milliseconds", row.runs[i].milliseconds},
                                                   {"survivors", row.runs[i].survivors}};
      }
    }
    entry["times_as_fast"] = Json::array();
    for_each_pair(table, [&](std::size_t ours, std::size_t other) {
      const Spread s = table.times_as_fast(row, ours, other);
      entry["times_as_fast"].push_back({{"ours", table.contenders[ours].name},
                                        {"yardstick", table.contenders[other].name},
                                        {"median", s.median},
                                        {"least", s.least},
                                        {"most", s.most}});
    });
  }
  return json.dump(1) + "\n";
}

}  // namespace halfspace
