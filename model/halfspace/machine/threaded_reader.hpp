/// Reads a packet stream in a thread of its own, while the units write on.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <span>
#include <thread>
#include <vector>

#include "halfspace/machine/packet_stream.hpp"
#include "halfspace/numerics/ring.hpp"

namespace halfspace {

/// Has `reader` read a frame in another thread: in order, up to a few parts later. Only begin() reaches it in
/// the thread of the units, before the other starts. What the reader throws is thrown at the units with a
/// later part, or by finish(). Not for units that ask for the cycles of bursts (shows_cycles), which need the
/// answer at once.
class ThreadedReader final : public StreamReader {
 public:
  explicit ThreadedReader(StreamReader& reader) : reader_(reader) {}
  ThreadedReader(const ThreadedReader&) = delete;
  ThreadedReader& operator=(const ThreadedReader&) = delete;
  /// Before finish(), parts that have not been read never are.
  ~ThreadedReader() override;

  [[nodiscard]] bool wants_accesses() const override { return reader_.wants_accesses(); }
  [[nodiscard]] bool wants_tiles() const override { return reader_.wants_tiles(); }
  [[nodiscard]] bool wants_live() const override { return reader_.wants_live(); }
  [[nodiscard]] bool has_time() const override { return reader_.has_time(); }

  void begin(std::span<const StreamSurface> surfaces, std::uint32_t memory_lines) override;
  void read(const StreamView& part, std::vector<std::uint64_t>* burst_cycles) override;
  void end(std::span<const ZFlush> dirty) override;

  /// After end(): returns when the reader has read all.
  void finish();

 private:
  /// A copy of a part, or the end of the frame.
  struct Part {
    PacketStream packets;
    ZMissStream z;
    std::vector<StreamTile> tiles;
    std::vector<std::uint64_t> live;
    StreamView view;  ///< of the lists above
    std::vector<ZFlush> dirty;
    bool end = false;

    void copy(const StreamView& part);
  };

  void read_parts();
  void read_part(const Part& part);
  void stop();

  /// Enough for each side to be the faster one for a while, few enough to stay in the processor's caches.
  static constexpr std::uint32_t kParts = 8;

  StreamReader& reader_;
  Ring<Part, kParts> parts_;
  std::atomic<bool> over_ = false;  ///< nobody needs parts any more
  std::exception_ptr error_;        ///< that the reader threw; to be looked at when the thread has stopped
  std::jthread thread_;
};

}  // namespace halfspace
