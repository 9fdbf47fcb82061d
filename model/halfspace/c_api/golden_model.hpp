/// What is behind a halfspace_model: configuration, then the units and what they expect on each link.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/c_api/unit_chain.hpp"
#include "halfspace/config/config.hpp"

namespace halfspace::c_api {

/// The functions of halfspace.h, with InputError for what they refuse. `packet` has the bits the caller says.
class GoldenModel {
 public:
  void configure_file(const std::string& path);
  void configure(const std::string& toml);
  void set(const std::string& assignment);

  int packet_bits(int link);
  void watch(int link);
  void put(int link, const std::uint32_t* packet, int bits);
  /// False: none is expected.
  bool get(int link, std::uint32_t* packet, int bits);
  /// How the packet differs from the one expected.
  std::optional<std::string> check(int link, const std::uint32_t* packet, int bits);
  std::size_t pending(int link);
  void reset();

  DepthSurfaces& surfaces();
  int tile_size();

 private:
  void demand_configurable() const;
  /// Fixes the configuration.
  ChainContext& context();
  ExpectedPackets& watched(int link);
  /// The packet without the bits above it.
  std::vector<std::uint32_t> words_of(LinkId link, const std::uint32_t* packet, int bits);

  Config config_;
  std::unique_ptr<ChainContext> context_;
  std::unique_ptr<UnitChain> chain_;
  bool started_ = false;  ///< a packet was put
};

}  // namespace halfspace::c_api
