// The write buffer of the z cache: lines on their way to memory, in order. Several enter in a cycle, one a part of the
// tile; they leave one after the other, as memory's bytes.

module z_write_buffer
  import raster_pkg::*;
#(
  /// Lines, ZParts or more.
  parameter int unsigned WriteBuffers = 4,
  /// Bytes that memory writes in a cycle: a power of two.
  parameter int unsigned WriteBytes = 64,
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 1024,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned PartQuads = TileQuads / ZParts,
  localparam int unsigned LineBytes = 4 * MaskBits / ZParts,
  localparam int unsigned WriteBits = 8 * (WriteBytes < LineBytes ? WriteBytes : LineBytes),
  localparam int unsigned CountBits = $clog2(WriteBuffers + 1)
) (
  input  logic                             clk_i,
  input  logic                             rst_ni,

  // Lines that enter, in order of parts, with their tiles; free_o has room for them.
  input  logic [ZParts-1:0]                push_i,
  input  logic [ZParts-1:0] [TileBits-1:0] tile_i,
  input  logic [ZParts-1:0]                half_i,
  input  logic [ZParts-1:0] [PartQuads-1:0] [3:0] [CodeBits-1:0] lines_i,  // codes by quad
  output logic [CountBits-1:0]             free_o,

  // Whether this part of this tile is in the buffer.
  input  logic [ZParts-1:0]                leaving_part_i,
  input  logic [TileBits-1:0]              leaving_tile_i,
  output logic                             leaving_o,

  output logic                             write_valid_o,
  input  logic                             write_ready_i,
  output logic [LineBits-1:0]              write_line_o,
  output logic                             write_half_o,
  output logic                             write_last_o,
  output logic [WriteBits-1:0]             write_data_o
);

  localparam int unsigned WriteFull = LineBytes > WriteBytes ? LineBytes / WriteBytes : 1;
  localparam int unsigned WriteHalf = LineBytes / 2 > WriteBytes ? LineBytes / 2 / WriteBytes : 1;
  localparam int unsigned BeatBits = WriteFull > 1 ? $clog2(WriteFull) : 1;
  localparam int unsigned PointerBits = WriteBuffers > 1 ? $clog2(WriteBuffers) : 1;

  typedef logic [PartQuads-1:0] [3:0] [CodeBits-1:0] line_t;
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
  line_t    lines_q  [WriteBuffers];
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
        lines_q[slot[p]]  <= lines_i[p];
      end
    end
  end

  place_t writing;
  logic   write_end;
  assign writing       = places_q[write_q];
  assign write_valid_o = used_q != '0;
  assign write_half_o  = writing.half;
  assign write_last_o  = beat_q == BeatBits'((writing.half ? WriteHalf : WriteFull) - 1);
  assign write_end     = write_valid_o & write_ready_i & write_last_o;
  assign free_o        = count_t'(WriteBuffers) - used_q;

  always_comb begin
    write_line_o = LineBits'(writing.tile) * LineBits'(ZParts);
    for (int unsigned p = 0; p < ZParts; p++) begin
      if (writing.part[p]) begin
        write_line_o |= LineBits'(p);
      end
    end
  end

  // Codes become memory's bytes as they leave, piece by piece: a piece is of one code in both formats.
  localparam int unsigned PieceBits = WriteBits < 16 ? WriteBits : 16;
  localparam int unsigned Pieces = WriteBits / PieceBits;    // of a beat
  localparam int unsigned FullPieces = CodeBits / PieceBits; // of a code
  localparam int unsigned HalfPieces = FullPieces / 2;
  localparam int unsigned HalfLine = MaskBits / ZParts * HalfPieces;

  function automatic int unsigned quad_of(int unsigned place);
    return place / TileSize / 2 * (TileSize / 2) + place % TileSize / 2;
  endfunction
  function automatic int unsigned sample_of(int unsigned place);
    return place / TileSize % 2 * 2 + place % 2;
  endfunction

  line_t line;
  assign line = lines_q[write_q];

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
