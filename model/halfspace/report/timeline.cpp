#include "halfspace/report/timeline.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

constexpr std::array<const char*, 2> kChannelName{"read", "write"};

}  // namespace

Timeline::Timeline(std::filesystem::path path, const Frame& frame, const Config& config,
                   const TimelineChoice& choice)
    : path_(std::move(path)),
      file_(path_),
      choice_(choice),
      window_(choice.cycles.value_or(TimelineRange{})) {
  const auto draws = static_cast<std::uint64_t>(
      std::count_if(frame.commands.begin(), frame.commands.end(),
                    [](const Command& command) { return command.kind == CommandKind::kDraw; }));
  if (choice_.draws) {
    if (choice_.draws->last >= draws) {
      throw OptionError(fmt::format("the timeline is to show draws {} to {}; '{}' has {}, counted from 0",
                                    choice_.draws->first, choice_.draws->last, frame.name, draws));
    }
    chosen_ = false;
    for (Counter& counter : counters_) {
      counter.shown = {.first = std::numeric_limits<std::uint64_t>::max(), .last = 0};
    }
  }
  write_head(frame, config);
}

void Timeline::write_head(const Frame& frame, const Config& config) {
  // Numbers and names of ours are all that events hold; only here is text from outside, to be quoted.
  const nlohmann::ordered_json about{{"tool", "halfspace"},
                                     {"version", HALFSPACE_VERSION},
                                     {"frame", frame.name},
                                     {"config_hash", config_hash(config)},
                                     {"time", "1 cycle is shown as 1 us"}};
  fmt::format_to(std::back_inserter(buffer_), "{{\"otherData\":{},\n\"traceEvents\":[", about.dump());
  const auto name_process = [this](Process process, std::string_view name) {
    fmt::format_to(std::back_inserter(begin_event()),
                   R"({{"ph":"M","name":"process_name","pid":{},"args":{{"name":"{}"}}}})",
                   static_cast<int>(process), name);
  };
  name_process(Process::kStages, "stages");
  for (std::size_t i = 0; i < kStages; ++i) {
    name_track(Process::kStages, i, kStageInfo[i].name);
  }
  name_process(Process::kLinks, "links: credits in use");
  name_process(Process::kMemory, "memory");
  for (std::size_t i = 0; i < kChannelName.size(); ++i) {
    name_track(Process::kMemory, i, kChannelName[i]);
  }
}

void Timeline::name_track(Process process, std::size_t track, std::string_view name) {
  const int pid = static_cast<int>(process);
  fmt::format_to(std::back_inserter(begin_event()),
                 R"({{"ph":"M","name":"thread_name","pid":{},"tid":{},"args":{{"name":"{}"}}}})", pid, track,
                 name);
  fmt::format_to(std::back_inserter(begin_event()),
                 R"({{"ph":"M","name":"thread_sort_index","pid":{},"tid":{},"args":{{"sort_index":{}}}}})",
                 pid, track, track);
}

void Timeline::draw(std::uint32_t index) {
  draw_ = index == kNoDraw ? std::nullopt : std::optional(index);
  triangles_ = jobs_ = bursts_ = 0;
  if (!choice_.draws) {
    return;
  }
  if (draw_) {
    chosen_ = choice_.draws->holds(index);
    last_draw_ = index;
  } else {
    chosen_ = chosen_ && last_draw_ != choice_.draws->last;  // a clear between two chosen draws
  }
}

void Timeline::drained() {
  draw_.reset();
  drained_ = true;
  chosen_ = !choice_.draws;
}

void Timeline::link(Link link, std::uint64_t from, std::uint64_t to) {
  triangles_ += link == Link::kSetupQueue ? 1 : 0;
  bursts_ += link == Link::kQuadGenerator ? 1 : 0;
  if (link == Link::kTileWalker) {
    ++jobs_;
    tile_ = next_tile_;
    next_tile_.reset();
  }
  const auto i = static_cast<std::size_t>(link);
  Counter& counter = counters_[i];
  return_credits(i, from);
  if (chosen_ && choice_.draws) {
    counter.shown = {.first = std::min(counter.shown.first, from), .last = std::max(counter.shown.last, to)};
  }
  change(i, from, true);
  counter.back.push_back(to);
}

void Timeline::return_credits(std::size_t link, std::uint64_t cycle) {
  std::deque<std::uint64_t>& back = counters_[link].back;
  while (!back.empty() && back.front() <= cycle) {
    change(link, back.front(), false);
    back.pop_front();
  }
}

void Timeline::change(std::size_t link, std::uint64_t cycle, bool taken) {
  Counter& counter = counters_[link];
  if (counter.cycle != cycle) {
    write_change(link);
    counter.cycle = cycle;
    counter.before = counter.in_use;
  }
  counter.in_use = taken ? counter.in_use + 1 : counter.in_use - 1;
}

/// Of the cycle that is past, in which several credits may have moved.
void Timeline::write_change(std::size_t link) {
  Counter& counter = counters_[link];
  const TimelineRange shown{.first = std::max(counter.shown.first, window_.first),
                            .last = std::min(counter.shown.last, window_.last)};
  if (counter.cycle < shown.first || shown.last < shown.first) {
    return;
  }
  if (!counter.written && counter.cycle > shown.first) {
    count(link, shown.first, counter.before);
  }
  if (counter.cycle <= shown.last && counter.written != counter.in_use) {
    count(link, counter.cycle, counter.in_use);
  }
}

void Timeline::count(std::size_t link, std::uint64_t cycle, std::uint64_t in_use) {
  counters_[link].written = in_use;
  fmt::format_to(std::back_inserter(begin_event()),
                 R"({{"ph":"C","pid":{},"name":"{}","ts":{},"args":{{"credits":{}}}}})",
                 static_cast<int>(Process::kLinks), kLinkName[link], cycle, in_use);
}

void Timeline::slice(Stage stage, std::optional<std::size_t> stall, std::uint64_t from, std::uint64_t to) {
  const auto track = static_cast<std::size_t>(stage);
  const PacketKind work = kStageInfo[track].works_on;
  if (stall) {
    span(Process::kStages, track, "stall", kStageInfo[track].stall[*stall], from, to, work);
  } else {
    span(Process::kStages, track, "busy", packet(work), from, to, work);
  }
}

void Timeline::transfer(Channel channel, std::uint64_t from, std::uint64_t to) {
  span(Process::kMemory, static_cast<std::size_t>(channel), "busy", packet(PacketKind::kBurst), from, to,
       PacketKind::kBurst);
}

void Timeline::span(Process process, std::size_t track, std::string_view category, std::string_view name,
                    std::uint64_t from, std::uint64_t to, PacketKind work) {
  const std::uint64_t first = std::max(from, window_.first);
  const std::uint64_t last = std::min(to - 1, window_.last);
  if (!chosen_ || first > last) {
    return;
  }
  fmt::format_to(std::back_inserter(begin_event()),
                 R"({{"ph":"X","pid":{},"tid":{},"cat":"{}","name":"{}","ts":{},"dur":{},"args":{{{}}}}})",
                 static_cast<int>(process), track, category, name, first, last - first + 1, arguments(work));
}

/// The packet's name: of the draw and its number there, counted from 0.
std::string Timeline::packet(PacketKind work) const {
  if (drained_) {
    return "flush";
  }
  const std::string draw = draw_ ? fmt::format("draw {}", *draw_) : "clear";
  switch (work) {
    case PacketKind::kTriangle:
      return fmt::format("{} triangle {}", draw, triangles_ - 1);
    case PacketKind::kJob:
      return fmt::format("{} job {}", draw, jobs_ - 1);
    default:
      return fmt::format("{} burst {}", draw, bursts_ - 1);
  }
}

std::string Timeline::arguments(PacketKind work) const {
  if (drained_) {
    return {};
  }
  std::string text = draw_ ? fmt::format(R"("draw":{},)", *draw_) : "";
  text += fmt::format(R"("triangle":{})", triangles_ - 1);
  if (work != PacketKind::kTriangle) {
    text += fmt::format(R"(,"job":{})", jobs_ - 1);
    text += tile_ ? fmt::format(R"(,"x":{},"y":{})", tile_->x, tile_->y) : "";
  }
  if (work == PacketKind::kBurst) {
    text += fmt::format(R"(,"burst":{})", bursts_ - 1);
  }
  return text;
}

/// Counts an event, and gives the place to write it to.
fmt::memory_buffer& Timeline::begin_event() {
  if (++events_ > kMostTimelineEvents) {
    throw OptionError(
        fmt::format("the timeline has more than {} events; choose a part of the frame with --timeline-draws "
                    "or --timeline-cycles",
                    kMostTimelineEvents));
  }
  if (buffer_.size() > kBufferBytes) {
    empty_buffer();
  }
  constexpr std::string_view kNext{",\n"};
  buffer_.append(events_ == 1 ? kNext.substr(1) : kNext);
  return buffer_;
}

void Timeline::empty_buffer() {
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void Timeline::finish(std::uint64_t cycles) {
  if (choice_.cycles && choice_.cycles->first >= cycles) {
    throw OptionError(fmt::format("the timeline is to begin in cycle {}; the frame's last is {}",
                                  choice_.cycles->first, cycles - 1));
  }
  for (std::size_t i = 0; i < kLinks; ++i) {
    return_credits(i, cycles);
    write_change(i);
    const std::uint64_t first = std::max(counters_[i].shown.first, window_.first);
    if (!counters_[i].written && first < cycles) {
      count(i, first, counters_[i].in_use);  // it did not change any more
    }
  }
  fmt::format_to(std::back_inserter(buffer_), "\n]}}\n");
  empty_buffer();
  file_.close();
  if (!file_) {
    throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
  }
}

}  // namespace halfspace
