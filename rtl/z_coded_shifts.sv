// By how much each line of one part is coded in memory. Reset makes all words invalid, which reads as lines that are not
// coded.

module z_coded_shifts
  import z_codec_pkg::*;
#(
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned Tiles = 1024,
  localparam int unsigned TileBits = $clog2(Tiles)
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  input  logic [TileBits-1:0] tile_i,
  output coded_shift_t        shift_o,

  input  logic                written_i,
  input  logic [TileBits-1:0] written_tile_i,
  input  coded_shift_t        written_shift_i
);

  localparam int unsigned WordTiles = 16;
  localparam int unsigned Words = (Tiles + WordTiles - 1) / WordTiles;
  localparam int unsigned AddressBits = Words > 1 ? $clog2(Words) : 1;

  typedef logic [AddressBits-1:0] address_t;
  typedef coded_shift_t [WordTiles-1:0] word_t;

  function automatic address_t address_of(logic [TileBits-1:0] tile);
    return address_t'(int'(tile) / WordTiles);
  endfunction
  function automatic logic [$clog2(WordTiles)-1:0] place_of(logic [TileBits-1:0] tile);
    return ($clog2(WordTiles))'(int'(tile) % WordTiles);
  endfunction

  word_t            words_q [Words];
  logic [Words-1:0] valid_q;
  word_t            written, read;
  address_t         address, read_address;

  assign address      = address_of(written_tile_i);
  assign read_address = address_of(tile_i);

  // A word is written whole; what is invalid counts as not coded.
  always_comb begin
    written = valid_q[address] ? words_q[address] : '0;
    written[place_of(written_tile_i)] = written_shift_i;
  end

  always_ff @(posedge clk_i) begin
    if (written_i) begin
      words_q[address] <= written;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else if (written_i) begin
      valid_q[address] <= 1'b1;
    end
  end

  assign read    = words_q[read_address];
  assign shift_o = valid_q[read_address] ? read[place_of(tile_i)] : '0;

endmodule
