// One bit for each line of one part in memory: the line is only marked cleared, memory does not hold it.
//
// A clear sets up to ClearTiles bits in a cycle, from any line on: two banks of words, so that a window that is not
// aligned still needs one word of each. Reset makes all words invalid, which reads as not cleared.

module z_clear_flags #(
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned Tiles = 1024,
  /// Bits that a clear sets in a cycle: a power of two.
  parameter int unsigned ClearTiles = 64,
  localparam int unsigned TileBits = $clog2(Tiles)
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  input  logic [TileBits-1:0] tile_i,
  output logic                cleared_o,

  // Sets `first` to `first` + ClearTiles - 1, but none after `last`.
  input  logic                clear_i,
  input  logic [TileBits-1:0] first_i,
  input  logic [TileBits-1:0] last_i,

  // Resets one; never in the cycle of clear_i.
  input  logic                stored_i,
  input  logic [TileBits-1:0] stored_tile_i
);

  localparam int unsigned OffsetLog2 = $clog2(ClearTiles);
  localparam int unsigned Words = ((Tiles + ClearTiles - 1) / ClearTiles + 1) / 2; // of a bank
  localparam int unsigned WideBits = TileBits + OffsetLog2 + 2; // holds every sum below

  typedef logic [WideBits-1:0] wide_t;
  typedef logic [ClearTiles-1:0] flags_t;

  localparam flags_t All = '1;

  function automatic wide_t word_of(logic [TileBits-1:0] tile);
    return wide_t'(tile) >> OffsetLog2;
  endfunction
  function automatic wide_t offset_of(logic [TileBits-1:0] tile);
    return wide_t'(tile) & wide_t'(ClearTiles - 1);
  endfunction

  localparam int unsigned AddressBits = Words > 1 ? $clog2(Words) : 1;
  typedef logic [AddressBits-1:0] address_t;

  logic [1:0] found;
  for (genvar bank = 0; bank < 2; bank++) begin : gen_bank
    flags_t           flags_q [Words];
    logic [Words-1:0] valid_q;

    // The word that a clear writes here: that of `first`, or the next.
    wide_t    clear_word;
    flags_t   window, up_to, set, unset, stored;
    logic     clear_here, stored_here;
    address_t address;

    assign clear_word  = word_of(first_i) + wide_t'(word_of(first_i) % wide_t'(2) != wide_t'(bank));
    assign clear_here  = clear_i && clear_word >> 1 < wide_t'(Words);
    assign stored_here = stored_i && word_of(stored_tile_i) % wide_t'(2) == wide_t'(bank);
    assign address     = address_t'((clear_i ? clear_word : word_of(stored_tile_i)) >> 1);

    // Of the window that begins with `first`, its word has the bits from there on and the next word those before.
    assign window    = clear_word == word_of(first_i) ? All << offset_of(first_i)
                                                      : ~(All << offset_of(first_i));
    assign up_to     = clear_word < word_of(last_i)    ? All
                       : clear_word == word_of(last_i) ? ~(All << offset_of(last_i) << 1) : '0;
    assign set       = window & up_to;
    assign unset     = stored_here ? flags_t'(1) << offset_of(stored_tile_i) : '0;
    assign stored    = flags_q[address];

    // A word is written whole; what a clear finds invalid counts as not cleared.
    always_ff @(posedge clk_i) begin
      if (clear_here) begin
        flags_q[address] <= valid_q[address] ? stored | set : set;
      end else if (stored_here) begin
        flags_q[address] <= stored & ~unset;
      end
    end

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        valid_q <= '0;
      end else if (clear_here) begin
        valid_q[address] <= 1'b1;
      end
    end

    address_t read_address;
    flags_t   word;
    assign read_address = address_t'(word_of(tile_i) >> 1);
    assign word         = flags_q[read_address] >> offset_of(tile_i);
    assign found[bank]  = word_of(tile_i) % wide_t'(2) == wide_t'(bank)
                          && valid_q[read_address] && word[0];

    logic unused_word;
    assign unused_word = ^word;
  end

  assign cleared_o = |found;

endmodule
