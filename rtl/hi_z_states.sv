// What the word of each block of all surfaces is: unknown, cleared or stored. At the end of a frame all become unknown at
// once, and a clear marks ClearBlocks blocks in a cycle, from any block on: two banks of flags, as in z_clear_flags.

module hi_z_states #(
  /// Blocks of all surfaces, 2 or more.
  parameter int unsigned MemoryBlocks = 1024,
  /// Blocks that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearBlocks = 64,
  localparam int unsigned BlockBits = $clog2(MemoryBlocks)
) (
  input  logic                 clk_i,
  /// All blocks become unknown.
  input  logic                 rst_ni,

  // Two readers; each sees what was written before this cycle.
  input  logic [1:0][BlockBits-1:0] block_i,
  output logic [1:0]                stored_o,
  output logic [1:0]                cleared_o, // unless it is stored

  // Marks `first` to `first` + ClearBlocks - 1 as cleared, but none after `last`.
  input  logic                 clear_i,
  input  logic [BlockBits-1:0] first_i,
  input  logic [BlockBits-1:0] last_i,

  // Marks one as stored; never in the cycle of clear_i.
  input  logic                 store_i,
  input  logic [BlockBits-1:0] store_block_i
);

  localparam int unsigned OffsetLog2 = $clog2(ClearBlocks);
  localparam int unsigned AllWords = (MemoryBlocks + ClearBlocks - 1) / ClearBlocks;
  localparam int unsigned Words = (AllWords + 1) / 2; // of a bank
  localparam int unsigned WideBits = BlockBits + OffsetLog2 + 2; // holds every sum below
  localparam int unsigned AddressBits = Words > 1 ? $clog2(Words) : 1;

  typedef logic [WideBits-1:0] wide_t;
  typedef logic [ClearBlocks-1:0] flags_t;
  typedef logic [AddressBits-1:0] address_t;

  localparam flags_t All = '1;
  localparam flags_t NotFirst = All - flags_t'(1);

  function automatic wide_t word_of(logic [BlockBits-1:0] block);
    return wide_t'(block) >> OffsetLog2;
  endfunction
  function automatic wide_t offset_of(logic [BlockBits-1:0] block);
    return wide_t'(block) & wide_t'(ClearBlocks - 1);
  endfunction

  logic [1:0][1:0] stored, cleared; // by bank

  for (genvar bank = 0; bank < 2; bank++) begin : gen_bank
    flags_t           stored_q  [Words];
    flags_t           cleared_q [Words];
    logic [Words-1:0] valid_q;

    // The word that a clear writes here: that of `first`, or the next.
    wide_t    clear_word;
    flags_t   window, up_to, set, store, was_stored, was_cleared;
    logic     clear_here, store_here;
    address_t address;

    assign clear_word = word_of(first_i)
                        + wide_t'(word_of(first_i) % wide_t'(2) != wide_t'(bank));
    assign clear_here = clear_i && clear_word >> 1 < wide_t'(Words);
    assign store_here = store_i && word_of(store_block_i) % wide_t'(2) == wide_t'(bank);
    assign address    = address_t'((clear_i ? clear_word : word_of(store_block_i)) >> 1);

    // Of the window that begins with `first`, its word has the bits from there on and the next word those before.
    assign window = clear_word == word_of(first_i) ? All << offset_of(first_i)
                                                   : ~(All << offset_of(first_i));
    assign up_to  = clear_word < word_of(last_i)    ? All
                    : clear_word == word_of(last_i) ? ~(NotFirst << offset_of(last_i)) : '0;
    assign set    = window & up_to;
    assign store  = flags_t'(1) << offset_of(store_block_i);

    assign was_stored  = valid_q[address] ? stored_q[address] : '0;
    assign was_cleared = valid_q[address] ? cleared_q[address] : '0;

    always_ff @(posedge clk_i) begin
      if (clear_here) begin
        stored_q[address]  <= was_stored & ~set;
        cleared_q[address] <= was_cleared | set;
      end else if (store_here) begin
        stored_q[address]  <= was_stored | store;
        cleared_q[address] <= was_cleared;
      end
    end

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        valid_q <= '0;
      end else if (clear_here || store_here) begin
        valid_q[address] <= 1'b1;
      end
    end

    for (genvar port = 0; port < 2; port++) begin : gen_port
      address_t read_address;
      flags_t   read_stored, read_cleared;
      logic     here;
      assign read_address        = address_t'(word_of(block_i[port]) >> 1);
      assign read_stored         = stored_q[read_address] >> offset_of(block_i[port]);
      assign read_cleared        = cleared_q[read_address] >> offset_of(block_i[port]);
      assign here                = word_of(block_i[port]) % wide_t'(2) == wide_t'(bank)
                                   && valid_q[read_address];
      assign stored[bank][port]  = here && read_stored[0];
      assign cleared[bank][port] = here && read_cleared[0];

      logic unused_words;
      assign unused_words = ^{read_stored, read_cleared};
    end
  end

  assign stored_o  = stored[0] | stored[1];
  assign cleared_o = cleared[0] | cleared[1];

endmodule
