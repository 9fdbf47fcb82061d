/// URIs of a glTF file: percent-encoded paths, and data inside the URI (RFC 3986, RFC 2397).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfspace::gltf {

/// The text with each %XX replaced by its byte; a percent sign without two digits stands for itself.
[[nodiscard]] std::string percent_decode(std::string_view text);

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes in a data URI of any media type; nothing when it has no comma or is not sound base64.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// Whether the URI begins with a scheme ("https:", "file:").
[[nodiscard]] bool has_scheme(std::string_view uri);

}  // namespace halfspace::gltf
