#include "halfspace/scene/image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it before
#include <cstring>

#include <jpeglib.h>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

void check_image_size(std::uint64_t width, std::uint64_t height, std::uint64_t texels) {
  if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize || width * height > texels) {
    throw InputError(fmt::format("image has {} x {} texels; legal: 1 to {} on a side, {} in all", width,
                                 height, kMaxImageSize, texels));
  }
}

Image empty_image(std::uint32_t width, std::uint32_t height) {
  return {.width = width, .height = height, .texels = decltype(Image::texels)(std::size_t{width} * height)};
}

Image decode_png(std::span<const std::byte> bytes, std::uint64_t texels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    throw InputError(fmt::format("PNG is damaged: {}", png.message));
  }
  try {
    check_image_size(png.width, png.height, texels);
  } catch (const InputError&) {
    png_image_free(&png);
    throw;
  }
  png.format = PNG_FORMAT_RGBA;  // 8 bits, encoded as sRGB
  Image image = empty_image(png.width, png.height);
  if (png_image_finish_read(&png, nullptr, image.texels.data(), 0, nullptr) == 0) {
    throw InputError(fmt::format("PNG is damaged: {}", png.message));
  }
  return image;
}

/// libjpeg reports an error by a function that must not return to it.
struct JpegError {
  jpeg_error_mgr manager;  // first: libjpeg knows its address alone
  std::jmp_buf escape;
  std::array<char, JMSG_LENGTH_MAX> message;
};

[[noreturn]] void on_jpeg_error(j_common_ptr jpeg) {
  auto* const error = reinterpret_cast<JpegError*>(jpeg->err);
  jpeg->err->format_message(jpeg, error->message.data());
  std::longjmp(error->escape, 1);  // NOLINT(cert-err52-cpp): C is in between, through which none may throw
}

/// A warning, as of a file that ends early, is damage, too.
void on_jpeg_message(j_common_ptr jpeg, int level) {
  if (level < 0) on_jpeg_error(jpeg);
}

/// What is done between a call of libjpeg and its error has no destructor: nothing of C++ is skipped.
class JpegReader {
 public:
  explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {
    jpeg_.err = jpeg_std_error(&error_.manager);
    error_.manager.error_exit = on_jpeg_error;
    error_.manager.emit_message = on_jpeg_message;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  Image run(std::uint64_t texels) {
    check(begin());
    check_image_size(jpeg_.image_width, jpeg_.image_height, texels);
    Image image = empty_image(jpeg_.image_width, jpeg_.image_height);
    std::vector<std::uint8_t> row(std::size_t{3} * image.width);
    check(start());
    for (std::uint32_t y = 0; y < image.height; ++y) {
      check(read_row(row.data()));
      for (std::size_t x = 0; x < image.width; ++x) {
        image.texels[std::size_t{y} * image.width + x] = {row[3 * x], row[3 * x + 1], row[3 * x + 2], 255};
      }
    }
    return image;
  }

 private:
  void check(bool good) const {
    if (!good) throw InputError(fmt::format("JPEG is damaged: {}", error_.message.data()));
  }

  // NOLINTBEGIN(cert-err52-cpp)
  bool begin() {
    if (setjmp(error_.escape) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }
  bool start() {
    if (setjmp(error_.escape) != 0) return false;
    jpeg_.out_color_space = JCS_RGB;
    jpeg_start_decompress(&jpeg_);
    return true;
  }
  bool read_row(std::uint8_t* row) {
    if (setjmp(error_.escape) != 0) return false;
    jpeg_read_scanlines(&jpeg_, &row, 1);
    return true;
  }
  // NOLINTEND(cert-err52-cpp)

  std::span<const std::byte> bytes_;
  jpeg_decompress_struct jpeg_{};
  JpegError error_{};
};

bool begins_with(std::span<const std::byte> bytes, std::span<const unsigned char> magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

Image decode_image(std::span<const std::byte> bytes, std::uint64_t texels) {
  constexpr std::array<unsigned char, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::array<unsigned char, 3> kJpeg{0xFF, 0xD8, 0xFF};
  if (begins_with(bytes, kPng)) return decode_png(bytes, texels);
  if (begins_with(bytes, kJpeg)) return JpegReader(bytes).run(texels);
  throw InputError("image is neither PNG nor JPEG; legal: one of them");
}

}  // namespace halfspace
