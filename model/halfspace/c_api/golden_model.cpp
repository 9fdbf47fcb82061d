#include "halfspace/c_api/golden_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/numerics/error.hpp"

namespace halfspace::c_api {
namespace {

void demand_packet(const void* packet) {
  if (packet == nullptr) {
    throw InputError("packet is a null pointer; legal: words of a packet");
  }
}

void demand_bits(LinkId link, int bits, int legal) {
  if (bits != legal) {
    throw InputError(fmt::format("a packet of {} bits on link {} ({}); legal: {}", bits,
                                 static_cast<int>(link), link_name(link), legal));
  }
}

}  // namespace

void GoldenModel::configure_file(const std::string& path) {
  demand_configurable();
  config_ = read_config(path);
}

void GoldenModel::configure(const std::string& toml) {
  demand_configurable();
  config_ = parse_config(toml, "configuration");
}

void GoldenModel::set(const std::string& assignment) {
  demand_configurable();
  set_config(config_, assignment);
}

void GoldenModel::demand_configurable() const {
  if (context_ != nullptr) {
    throw InputError("the configuration is fixed; legal: before anything else is asked of the model");
  }
}

ChainContext& GoldenModel::context() {
  if (context_ != nullptr) {
    return *context_;
  }
  validate(config_);
  if (config_.raster.conservative != Conservative::kOff) {
    throw InputError("configuration key 'raster.conservative' is on; legal for the golden model: off");
  }
  if (!sample_pattern(config_).is_centre()) {
    throw InputError(
        fmt::format("configuration key 'raster.samples' is {}; legal in the golden model: 1, at the "
                    "pixel centre",
                    config_.raster.samples));
  }
  auto context = std::make_unique<ChainContext>();
  context->widths = widths(config_);
  context->interpolator = config_.depth.interpolator;
  context->walker = {.sub_pixel_bits = config_.raster.sub_pixel_bits,
                     .block_size = config_.block_walker.block_size,
                     .trivial_reject = config_.block_walker.trivial_reject,
                     .trivial_accept = config_.tile_walker.trivial_accept,
                     .sample_reject = config_.block_walker.sample_reject,
                     .levels = config_.block_walker.levels,
                     .order = config_.block_walker.order,
                     .tile_order = config_.tile_walker.order};
  for (int link = 0; link < HALFSPACE_LINKS; ++link) {
    context->expected.emplace_back(words_for(link_bits(static_cast<LinkId>(link), context->widths)));
  }
  chain_ = make_unit_chain(*context);
  context_ = std::move(context);
  return *context_;
}

DepthSurfaces& GoldenModel::surfaces() { return context().surfaces; }
int GoldenModel::tile_size() { return context().widths.TileSize; }

int GoldenModel::packet_bits(int link) {
  return link_bits(link_of(link, LinkId::kTriangle, LinkId::kTestedBeat), context().widths);
}

void GoldenModel::watch(int link) {
  const LinkId wanted = link_of(link, LinkId::kSetupTriangle, LinkId::kTestedBeat);
  ChainContext& all = context();
  if (started_) {
    throw InputError(fmt::format("link {} ({}) is watched too late; legal: before the first packet is put",
                                 link, link_name(wanted)));
  }
  all.watched[static_cast<std::size_t>(wanted)] = true;
  all.last = std::max(all.last, wanted);
}

ExpectedPackets& GoldenModel::watched(int link) {
  const LinkId wanted = link_of(link, LinkId::kSetupTriangle, LinkId::kTestedBeat);
  if (!context().watched[static_cast<std::size_t>(wanted)]) {
    throw InputError(
        fmt::format("link {} ({}) is not watched; legal: one that halfspace_watch was called with", link,
                    link_name(wanted)));
  }
  return context().expected[static_cast<std::size_t>(wanted)];
}

std::vector<std::uint32_t> GoldenModel::words_of(LinkId link, const std::uint32_t* packet, int bits) {
  demand_packet(packet);
  demand_bits(link, bits, link_bits(link, context().widths));
  std::vector<std::uint32_t> words(packet, packet + words_for(bits));
  if (bits % 32 != 0) {
    words.back() &= (1u << bits % 32) - 1;
  }
  return words;
}

void GoldenModel::put(int link, const std::uint32_t* packet, int bits) {
  const LinkId to = link_of(link, LinkId::kTriangle, LinkId::kQuadBeat);
  const std::vector<std::uint32_t> words = words_of(to, packet, bits);
  ChainContext& all = context();
  std::array<std::size_t, HALFSPACE_LINKS> before{};
  std::ranges::transform(all.expected, before.begin(), &ExpectedPackets::size);
  try {
    chain_->put(to, words);
  } catch (const InputError& error) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      all.expected[i].truncate(before[i]);
    }
    throw InputError(fmt::format("packet on link {} ({}): {}", link, link_name(to), error.what()));
  }
  started_ = true;
}

bool GoldenModel::get(int link, std::uint32_t* packet, int bits) {
  ExpectedPackets& expected = watched(link);
  demand_packet(packet);
  demand_bits(static_cast<LinkId>(link), bits, packet_bits(link));
  if (expected.size() == 0) {
    return false;
  }
  expected.peek(0, {packet, expected.packet_words()});
  expected.pop();
  return true;
}

std::optional<std::string> GoldenModel::check(int link, const std::uint32_t* packet, int bits) {
  ExpectedPackets& expected = watched(link);
  const std::vector<std::uint32_t> got = words_of(static_cast<LinkId>(link), packet, bits);
  const char* name = link_name(link);
  const std::uint64_t number = expected.taken();
  const bool again = std::ranges::equal(got, expected.last());
  if (expected.size() == 0) {
    return again ? fmt::format("{} packet {} came a second time, but none is expected", name, number - 1)
                 : fmt::format("{} packet {} came, but none is expected", name, number);
  }
  std::vector<std::uint32_t> want(got.size());
  expected.peek(0, want);
  if (want == got) {
    expected.pop();
    return std::nullopt;
  }
  const std::string fields = differences(link_fields(static_cast<LinkId>(link), context().widths), want, got);
  // One packet too few or too many must not make all that follow differ.
  if (expected.size() > 1) {
    expected.peek(1, want);
    if (want == got) {
      expected.pop();
      expected.pop();
      return fmt::format("{} packet {} is missing, packet {} came in its place: {}", name, number, number + 1,
                         fields);
    }
  }
  if (again) {
    return fmt::format("{} packet {} came a second time, in the place of packet {}: {}", name, number - 1,
                       number, fields);
  }
  expected.pop();
  return fmt::format("{} packet {}: {}", name, number, fields);
}

std::size_t GoldenModel::pending(int link) { return watched(link).size(); }

void GoldenModel::reset() {
  ChainContext& all = context();
  for (ExpectedPackets& expected : all.expected) {
    expected.reset();
  }
  chain_->reset();
  started_ = false;
}

}  // namespace halfspace::c_api
