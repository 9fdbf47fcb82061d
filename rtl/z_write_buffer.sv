// The write buffer of the z cache: lines on their way to memory, in order. Several enter in a cycle, one a part of the
// tile; they leave one after the other, as memory's bytes: the codes in row order, or what z_encoder makes of them.

module z_write_buffer
  import raster_pkg::*;
  import z_codec_pkg::*;
#(
  /// Lines, ZParts or more.
  parameter int unsigned WriteBuffers = 4,
  /// Bytes that memory writes in a cycle: a power of two.
  parameter int unsigned WriteBytes = 64,
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 1024,
  /// 1: lines are coded, and may be written ZEncodeLatency + 1 cycles later.
  parameter bit Compression = 1'b0,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned WriteBits = 8 * (WriteBytes < LineBytes ? WriteBytes : LineBytes),
  localparam int unsigned CountBits = $clog2(WriteBuffers + 1)
) (
  input  logic                             clk_i,
  input  logic                             rst_ni,

  // Lines that enter, in order of parts, with their tiles; free_o has room for them.
  input  logic [ZParts-1:0]                push_i,
  input  logic [ZParts-1:0] [TileBits-1:0] tile_i,
  input  logic [ZParts-1:0]                half_i,
  input  quads_t [ZParts-1:0]              lines_i,
  output logic [CountBits-1:0]             free_o,

  // Whether this part of this tile is in the buffer.
  input  logic [ZParts-1:0]                leaving_part_i,
  input  logic [TileBits-1:0]              leaving_tile_i,
  output logic                             leaving_o,

  output logic                             write_valid_o,
  input  logic                             write_ready_i,
  output logic [LineBits-1:0]              write_line_o,
  output logic                             write_half_o,
  output coded_shift_t                     write_shift_o,
  output logic                             write_last_o,
  output logic [WriteBits-1:0]             write_data_o,

  // A line is written, of this part and tile.
  output logic [ZParts-1:0]                written_o,
  output logic [TileBits-1:0]              written_tile_o
);

  localparam int unsigned WriteFull = LineBytes > WriteBytes ? LineBytes / WriteBytes : 1;
  localparam int unsigned BeatBits = WriteFull > 1 ? $clog2(WriteFull) : 1;
  localparam int unsigned PointerBits = WriteBuffers > 1 ? $clog2(WriteBuffers) : 1;

  typedef logic [PointerBits-1:0] pointer_t;
  typedef logic [CountBits-1:0]   count_t;
  typedef struct packed {
    logic [ZParts-1:0]   part;
    logic [TileBits-1:0] tile;
    logic                half;
  } place_t;

  function automatic pointer_t after(pointer_t pointer, int unsigned steps);
    automatic int unsigned sum = int'(pointer) + steps;
    return pointer_t'(sum >= WriteBuffers ? sum - WriteBuffers : sum);
  endfunction

  place_t   places_q [WriteBuffers];
  logic [WriteBuffers-1:0] in_use_q;
  count_t   used_q, pushed;
  pointer_t push_q, write_q;             // next to be filled, to be written
  logic [BeatBits-1:0] beat_q;
  pointer_t slot     [ZParts];

  always_comb begin
    pushed = '0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      slot[p] = after(push_q, int'(pushed));
      pushed += count_t'(push_i[p]);
    end
  end

  always_ff @(posedge clk_i) begin
    for (int unsigned p = 0; p < ZParts; p++) begin
      if (push_i[p]) begin
        places_q[slot[p]] <= '{part: ZParts'(1) << p, tile: tile_i[p], half: half_i[p]};
      end
    end
  end

  place_t writing;
  logic   write_end;
  assign writing       = places_q[write_q];
  assign write_half_o  = writing.half;
  assign write_end     = write_valid_o & write_ready_i & write_last_o;
  assign free_o        = count_t'(WriteBuffers) - used_q;
  assign written_o      = write_end ? writing.part : '0;
  assign written_tile_o = writing.tile;

  always_comb begin
    write_line_o = LineBits'(writing.tile) * LineBits'(ZParts);
    for (int unsigned p = 0; p < ZParts; p++) begin
      if (writing.part[p]) begin
        write_line_o |= LineBits'(p);
      end
    end
  end

  always_comb begin
    write_last_o = 1'b0;
    for (int unsigned shift = 0; shift <= (Compression ? MostCodedShift : 0); shift++) begin
      for (int unsigned half = 0; half < 2; half++) begin
        if (writing.half == half[0] && write_shift_o == coded_shift_t'(shift)) begin
          write_last_o = beat_q == (coded_bytes(half[0], shift) > WriteBytes
              ? BeatBits'(coded_bytes(half[0], shift) / WriteBytes - 1) : '0);
        end
      end
    end
  end

  if (Compression) begin : gen_encoder
    // A line, until its bytes take its place. Lines go into the encoder in order, one a cycle.
    data_t        slots_q  [WriteBuffers];
    coded_shift_t shifts_q [WriteBuffers];
    pointer_t     encode_q, coded_q;   // next to be encoded, to come out of it
    count_t       waiting_q, ready_q;  // lines before the encoder; behind it
    logic         encode, coded;
    coded_shift_t shift;
    data_t        data;

    assign encode = waiting_q != '0;

    z_encoder u_encoder (
      .clk_i   (clk_i),
      .rst_ni  (rst_ni),
      .valid_i (encode),
      .half_i  (places_q[encode_q].half),
      .codes_i (quads_t'(slots_q[encode_q])),
      .valid_o (coded),
      .shift_o (shift),
      .data_o  (data)
    );

    always_ff @(posedge clk_i) begin
      for (int unsigned p = 0; p < ZParts; p++) begin
        if (push_i[p]) begin
          slots_q[slot[p]] <= lines_i[p];
        end
      end
      if (coded) begin
        slots_q[coded_q]  <= data;
        shifts_q[coded_q] <= shift;
      end
    end

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        encode_q  <= '0;
        coded_q   <= '0;
        waiting_q <= '0;
        ready_q   <= '0;
      end else begin
        if (encode) begin
          encode_q <= after(encode_q, 1);
        end
        if (coded) begin
          coded_q <= after(coded_q, 1);
        end
        waiting_q <= waiting_q + pushed - count_t'(encode);
        ready_q   <= ready_q + count_t'(coded) - count_t'(write_end);
      end
    end

    assign write_valid_o = ready_q != '0;
    assign write_shift_o = shifts_q[write_q];

    always_comb begin
      write_data_o = '0;
      for (int unsigned beat = 0; beat < WriteFull; beat++) begin
        if (write_valid_o && beat_q == BeatBits'(beat)) begin
          write_data_o = slots_q[write_q][beat*WriteBits+:WriteBits];
        end
      end
    end
  end else begin : gen_plain
    // Codes become memory's bytes as they leave, piece by piece: a piece is of one code in both formats.
    localparam int unsigned WriteHalf =
        LineBytes / 2 > WriteBytes ? LineBytes / 2 / WriteBytes : 1;
    localparam int unsigned PieceBits = WriteBits < 16 ? WriteBits : 16;
    localparam int unsigned Pieces = WriteBits / PieceBits;    // of a beat
    localparam int unsigned FullPieces = CodeBits / PieceBits; // of a code
    localparam int unsigned HalfPieces = FullPieces / 2;
    localparam int unsigned HalfLine = Samples * HalfPieces;

    quads_t lines_q [WriteBuffers];
    quads_t line;
    assign line          = lines_q[write_q];
    assign write_valid_o = used_q != '0;
    assign write_shift_o = '0;

    always_ff @(posedge clk_i) begin
      for (int unsigned p = 0; p < ZParts; p++) begin
        if (push_i[p]) begin
          lines_q[slot[p]] <= lines_i[p];
        end
      end
    end

    always_comb begin
      write_data_o = '0;
      for (int unsigned beat = 0; beat < WriteFull; beat++) begin
        if (write_valid_o && !writing.half && beat_q == BeatBits'(beat)) begin
          for (int unsigned i = beat * Pieces; i < (beat + 1) * Pieces; i++) begin
            write_data_o[i%Pieces*PieceBits+:PieceBits] =
                line[quad_of(i/FullPieces)][sample_of(i/FullPieces)]
                    [i%FullPieces*PieceBits+:PieceBits];
          end
        end
      end
      for (int unsigned beat = 0; beat < WriteHalf; beat++) begin
        if (write_valid_o && writing.half && beat_q == BeatBits'(beat)) begin
          for (int unsigned i = beat * Pieces; i < (beat + 1) * Pieces && i < HalfLine; i++) begin
            write_data_o[i%Pieces*PieceBits+:PieceBits] =
                line[quad_of(i/HalfPieces)][sample_of(i/HalfPieces)]
                    [i%HalfPieces*PieceBits+:PieceBits];
          end
        end
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      used_q   <= '0;
      push_q   <= '0;
      write_q  <= '0;
      beat_q   <= '0;
      in_use_q <= '0;
    end else begin
      used_q <= used_q + pushed - count_t'(write_end);
      push_q <= after(push_q, int'(pushed));
      if (write_valid_o && write_ready_i) begin
        beat_q <= write_last_o ? '0 : beat_q + BeatBits'(1);
      end
      if (write_end) begin
        write_q           <= after(write_q, 1);
        in_use_q[write_q] <= 1'b0;
      end
      for (int unsigned p = 0; p < ZParts; p++) begin
        if (push_i[p]) begin
          in_use_q[slot[p]] <= 1'b1;
        end
      end
    end
  end

  always_comb begin
    leaving_o = 1'b0;
    for (int unsigned i = 0; i < WriteBuffers; i++) begin
      leaving_o |= leaving_part_i != '0 && in_use_q[i] && places_q[i].part == leaving_part_i
                   && places_q[i].tile == leaving_tile_i;
    end
  end

endmodule
