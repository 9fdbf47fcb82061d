// The words of hi_z: the bounds of every block of all surfaces, which jobs change and blocks read, both in order.
//
// A job is in its cycle 0 with apply_i, and puts its bounds in and writes the word in its cycle 1. A block reads in its
// cycle 1 with read_i, and has the word in its cycle 2. It sees what jobs have put in whose cycle 0 was in its own cycle
// 0 or before.

module hi_z_memory
  import raster_pkg::*;
#(
  /// Bits of a bound, 4 to 32.
  parameter int unsigned Bits = 8,
  /// Blocks of all surfaces, 2 or more.
  parameter int unsigned MemoryBlocks = 1024,
  /// Blocks that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearBlocks = 64,
  localparam int unsigned BlockBits = $clog2(MemoryBlocks),
  localparam int unsigned Entries = BlockTiles * ZParts,
  localparam int unsigned WordShiftBits = 5
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  // All blocks become unknown.
  input  logic                  forget_i,

  // A job in its cycle 0: of which block and tile. `apply_write_i`: it has bounds to put in.
  input  logic                  apply_i,
  input  logic                  apply_write_i,
  input  logic [BlockBits-1:0]  apply_number_i,
  input  logic [CodeBits-1:0]   apply_clear_code_i,
  input  logic [BlockTiles-1:0] apply_tile_i,
  input  hi_z_update_t          apply_update_i,

  // A block in its cycle 1, and in its cycle 2.
  input  logic                  read_i,
  input  logic [BlockBits-1:0]  read_number_i,
  input  logic [BlockBits-1:0]  number_i,
  input  logic [CodeBits-1:0]   clear_code_i,

  // Entry i lies from base + least[i] 2^shift to base + (most[i] + 1) 2^shift - 1.
  output logic [CodeBits-1:0]           base_o,
  output logic [WordShiftBits-1:0]      shift_o,
  output logic [Entries-1:0] [Bits-1:0] least_o,
  output logic [Entries-1:0] [Bits-1:0] most_o,

  // The surface of these blocks is cleared; a pulse in the cycle of the last mark.
  input  logic                  clear_i,
  input  logic [BlockBits-1:0]  clear_first_i,
  input  logic [BlockBits-1:0]  clear_last_i,
  output logic                  clear_done_o
);

  typedef logic [BlockBits-1:0] number_t;
  typedef logic [CodeBits-1:0] code_t;

  typedef struct packed {
    code_t                         base;
    logic [WordShiftBits-1:0]      shift;
    logic [Entries-1:0] [Bits-1:0] least;
    logic [Entries-1:0] [Bits-1:0] most;
  } block_word_t;

  localparam block_word_t Unknown = '{
    base: '0, shift: WordShiftBits'(CodeBits - Bits), least: '0, most: '1};

  function automatic block_word_t word_as(logic stored, logic cleared, block_word_t word,
                                          code_t clear_code);
    block_word_t clear_word;
    clear_word      = '0;
    clear_word.base = clear_code;
    return stored ? word : cleared ? clear_word : Unknown;
  endfunction

  logic frame_ni;
  assign frame_ni = rst_ni & ~forget_i;

  // What a word is. Blocks look in their cycle 2, jobs in their cycle 0.
  logic         store_q;           // a job in its cycle 1 writes
  number_t      number_q;
  logic [1:0]   stored, cleared;
  logic         mark_q;
  number_t      mark_first_q, mark_last_q;

  hi_z_states #(
    .MemoryBlocks (MemoryBlocks),
    .ClearBlocks  (ClearBlocks)
  ) u_states (
    .clk_i         (clk_i),
    .rst_ni        (frame_ni),
    .block_i       ({number_i, apply_number_i}),
    .stored_o      (stored),
    .cleared_o     (cleared),
    .clear_i       (mark_q),
    .first_i       (mark_first_q),
    .last_i        (mark_last_q),
    .store_i       (store_q),
    .store_block_i (number_q)
  );

  // A clear marks from the cycle after clear_i on, in which the last job may still write.
  logic    mark_end;
  number_t mark_after; // blocks
  assign mark_after   = mark_last_q - mark_first_q;
  assign mark_end     = 32'(mark_after) < ClearBlocks;
  assign clear_done_o = mark_q & mark_end;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      mark_q <= 1'b0;
    end else begin
      mark_q <= clear_i | (mark_q & ~mark_end);
    end
  end

  always_ff @(posedge clk_i) begin
    if (clear_i) begin
      mark_first_q <= clear_first_i;
      mark_last_q  <= clear_last_i;
    end else if (mark_q) begin
      mark_first_q <= mark_first_q + number_t'(ClearBlocks);
    end
  end

  // A job in its cycle 1.
  hi_z_update_t          update_q;
  logic [BlockTiles-1:0] tile_q;
  code_t                 clear_code_q;
  logic                  stored_q, cleared_q;

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      store_q <= 1'b0;
    end else begin
      store_q <= apply_i & apply_write_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (apply_i) begin
      number_q     <= apply_number_i;
      update_q     <= apply_update_i;
      tile_q       <= apply_tile_i;
      clear_code_q <= apply_clear_code_i;
      stored_q     <= stored[0];
      cleared_q    <= cleared[0];
    end
  end

  // The word that the job of the cycle before has made. It may not be in memory yet where another job or a block has read
  // it: what those got from a word in the cycle in which it was written, is not looked at.
  block_word_t made_q, put_word, read_word [2];
  number_t     made_number_q;
  logic        made_valid_q;

  // Copy 0 is for jobs, 1 for blocks.
  for (genvar copy = 0; copy < 2; copy++) begin : gen_words
    sync_ram #(
      .Width ($bits(block_word_t)),
      .Depth (MemoryBlocks)
    ) u_words (
      .clk_i           (clk_i),
      .write_i         (store_q),
      .write_address_i (number_q),
      .data_i          (put_word),
      .read_i          (copy == 0 ? apply_i : read_i),
      .read_address_i  (copy == 0 ? apply_number_i : read_number_i),
      .data_o          (read_word[copy])
    );
  end

  block_word_t        old_word, word;
  logic [Entries-1:0] put_entry;

  assign old_word = made_valid_q && made_number_q == number_q
                    ? made_q : word_as(stored_q, cleared_q, read_word[0], clear_code_q);
  assign word     = made_valid_q && made_number_q == number_i
                    ? made_q : word_as(stored[1], cleared[1], read_word[1], clear_code_i);

  assign {base_o, shift_o, least_o, most_o} = word;

  for (genvar i = 0; i < Entries; i++) begin : gen_put
    assign put_entry[i] = tile_q[i/ZParts] & update_q.touched[i%ZParts];
  end

  hi_z_word #(
    .Bits (Bits)
  ) u_word (
    .base_i      (old_word.base),
    .shift_i     (old_word.shift),
    .least_i     (old_word.least),
    .most_i      (old_word.most),
    .put_i       (put_entry),
    .put_least_i (update_q.least),
    .put_most_i  (update_q.most),
    .base_o      (put_word.base),
    .shift_o     (put_word.shift),
    .least_o     (put_word.least),
    .most_o      (put_word.most)
  );

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      made_valid_q <= 1'b0;
    end else begin
      made_valid_q <= store_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (store_q) begin
      made_q        <= put_word;
      made_number_q <= number_q;
    end
  end

endmodule
