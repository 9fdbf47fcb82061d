#include "job.hpp"

#include <algorithm>

namespace halfspace::tb {
namespace {

/// A link of several packets, the first in the highest bits.
class Link {
 public:
  Link(std::span<std::uint32_t> words, int bits) : words_(words), lsb_(bits) {
    std::ranges::fill(words_, 0u);
  }

  template <class Packet>
  void append(const Packet& packet, const Widths& widths) {
    const int bits = packed_bits<Packet>(widths);
    std::vector<std::uint32_t> part(words_for(bits));
    pack(packet, widths, part);
    lsb_ -= bits;
    for (int done = 0; done < bits; done += 32) {
      insert_bits(words_, lsb_ + done, std::min(32, bits - done), part[static_cast<std::size_t>(done / 32)]);
    }
  }

 private:
  std::span<std::uint32_t> words_;
  int lsb_;
};

template <class Packet>
Packet packet_at(std::span<const std::uint32_t> words, int lsb, const Widths& widths) {
  const int bits = packed_bits<Packet>(widths);
  std::vector<std::uint32_t> part(words_for(bits));
  for (int done = 0; done < bits; done += 32) {
    part[static_cast<std::size_t>(done / 32)] =
        static_cast<std::uint32_t>(extract_bits(words, lsb + done, std::min(32, bits - done)));
  }
  return unpack<Packet>(part, widths);
}

int state_bits(const Widths& widths) { return packed_bits<DrawStatePacket>(widths); }

int output_bits(const Widths& widths) {
  return packed_bits<SetupTrianglePacket>(widths) + packed_bits<DepthEquationPacket>(widths) +
         state_bits(widths);
}

template <class Packet>
void append_fields(std::vector<FieldSlot>& fields, const char* link, int lsb, const Widths& widths) {
  for (FieldSlot& field : field_slots<Packet>(widths)) {
    fields.push_back({link + ("." + field.name), field.lsb + lsb, field.width, field.sign});
  }
}

}  // namespace

std::size_t input_words(const Widths& widths) {
  return words_for(packed_bits<ScreenTrianglePacket>(widths) + state_bits(widths));
}

std::vector<FieldSlot> output_fields(const Widths& widths) {
  std::vector<FieldSlot> fields;
  const int equation = state_bits(widths);
  const int triangle = equation + packed_bits<DepthEquationPacket>(widths);
  append_fields<SetupTrianglePacket>(fields, "triangle", triangle, widths);
  append_fields<DepthEquationPacket>(fields, "equation", equation, widths);
  append_fields<DrawStatePacket>(fields, "state", 0, widths);
  return fields;
}

void pack_job(const SetupJob& job, const Widths& widths, std::span<std::uint32_t> words) {
  Link link(words, packed_bits<ScreenTrianglePacket>(widths) + state_bits(widths));
  link.append(job.triangle, widths);
  link.append(job.state, widths);
}

SetupJob unpack_job(std::span<const std::uint32_t> words, const Widths& widths) {
  return {packet_at<ScreenTrianglePacket>(words, state_bits(widths), widths),
          packet_at<DrawStatePacket>(words, 0, widths)};
}

SetupResult reference(const SetupJob& job, const SetupModel& model) {
  SetupResult result;
  SetupState state = setup_state(job.state, model.dut.sub_pixel_bits, model.interpolator());
  state.hi_z = model.hi_z;
  state.samples = model.pattern().box();
  if (job.triangle.by_square != 0) {
    state.conservative = model.conservative();
    state.square_reach = square_reach(state.conservative, model.uncertainty, model.dut.sub_pixel_bits);
  }
  const ScreenTriangle triangle = screen_triangle(job.triangle, state);
  result.verdict = setup(triangle, state, result.triangle);
  return result;
}

std::vector<std::uint32_t> output_words(const SetupJob& job, const SetupTriangle& triangle,
                                        const SetupModel& model) {
  const Widths widths = model.widths();
  std::vector<std::uint32_t> words(words_for(output_bits(widths)));
  Link link(words, output_bits(widths));
  link.append(to_packet(triangle, model.walker()), widths);
  link.append(to_packet(triangle, static_cast<DepthFormat>(job.state.format), model.interpolator()), widths);
  link.append(job.state, widths);
  return words;
}

}  // namespace halfspace::tb
