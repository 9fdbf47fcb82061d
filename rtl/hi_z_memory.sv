// The words of hi_z: the bounds of every block of all surfaces, which jobs change and blocks read, both in order.
//
// cycle of a job   | 0: with apply_i: read the word | 1: its bounds as codes, what those that stay span
//                  | 2: put the job's bounds in, round | 3: as steps, into memory
// cycle of a block | 1: with read_i: read the word | 2: what it holds
//
// A block sees what jobs have put in whose cycle 0 was before its own. A job takes what the three before it have made
// from their registers where they are of the same block, and a block what the last two have.

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
  localparam int unsigned Entries = BlockTiles * ZParts
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

  // All that is stored in a tile lies between these two, inclusive.
  output logic [BlockTiles-1:0][CodeBits-1:0] least_o,
  output logic [BlockTiles-1:0][CodeBits-1:0] most_o,

  // The surface of these blocks is cleared; a pulse in the cycle of the last mark.
  input  logic                  clear_i,
  input  logic [BlockBits-1:0]  clear_first_i,
  input  logic [BlockBits-1:0]  clear_last_i,
  output logic                  clear_done_o
);

  localparam int unsigned WordShiftBits = 5;

  typedef logic [BlockBits-1:0] number_t;
  typedef logic [CodeBits-1:0] code_t;
  typedef logic [Bits-1:0] bound_t;
  typedef logic [WordShiftBits-1:0] word_shift_t;
  typedef code_t [Entries-1:0] codes_t;

  // Entry i lies from base + least[i] 2^shift to base + (most[i] + 1) 2^shift - 1.
  typedef struct packed {
    code_t                base;
    word_shift_t          shift;
    bound_t [Entries-1:0] least;
    bound_t [Entries-1:0] most;
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

  // The first and the last code of a step: all bits below it are 0, or 1.
  localparam code_t Ones = '1;

  function automatic code_t first_code(code_t base, word_shift_t shift, bound_t step);
    return base + (code_t'(step) << shift);
  endfunction
  function automatic code_t last_code(code_t base, word_shift_t shift, bound_t step);
    return base + ((code_t'(step) << shift) | ~(Ones << shift));
  endfunction

  logic frame_ni;
  assign frame_ni = rst_ni & ~forget_i;

  // Jobs in their cycles 1 to 3, with bounds; and the one that was in cycle 3 in the cycle before.
  logic [4:1] valid_q;
  number_t    number_q [1:4];

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[3:1], apply_i & apply_write_i};
    end
  end

  always_ff @(posedge clk_i) begin
    if (apply_i) begin
      number_q[1] <= apply_number_i;
    end
    for (int unsigned i = 1; i < 4; i++) begin
      if (valid_q[i]) begin
        number_q[i+1] <= number_q[i];
      end
    end
  end

  // What a word is. Blocks look in their cycle 2, jobs in their cycle 0.
  logic [1:0] stored, cleared;
  logic       mark_q;
  number_t    mark_first_q, mark_last_q;

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
    .store_i       (valid_q[3]),
    .store_block_i (number_q[3])
  );

  // A clear marks from the second cycle after clear_i on: in the first the last job may still write.
  logic    clear_q, mark_end;
  number_t clear_first_q, clear_last_q, mark_after; // blocks
  assign mark_after   = mark_last_q - mark_first_q;
  assign mark_end     = 32'(mark_after) < ClearBlocks;
  assign clear_done_o = mark_q & mark_end;

  always_ff @(posedge clk_i) begin
    if (!frame_ni) begin
      clear_q <= 1'b0;
      mark_q  <= 1'b0;
    end else begin
      clear_q <= clear_i;
      mark_q  <= clear_q | (mark_q & ~mark_end);
    end
  end

  always_ff @(posedge clk_i) begin
    if (clear_i) begin
      clear_first_q <= clear_first_i;
      clear_last_q  <= clear_last_i;
    end
    if (clear_q) begin
      mark_first_q <= clear_first_q;
      mark_last_q  <= clear_last_q;
    end else if (mark_q) begin
      mark_first_q <= mark_first_q + number_t'(ClearBlocks);
    end
  end

  // Copy 0 is for jobs, 1 for blocks. What they get from a word in the cycle in which it is written, is not looked at.
  block_word_t made_word, read_word [2];

  for (genvar copy = 0; copy < 2; copy++) begin : gen_words
    sync_ram #(
      .Width ($bits(block_word_t)),
      .Depth (MemoryBlocks)
    ) u_words (
      .clk_i           (clk_i),
      .write_i         (valid_q[3]),
      .write_address_i (number_q[3]),
      .data_i          (made_word),
      .read_i          (copy == 0 ? apply_i : read_i),
      .read_address_i  (copy == 0 ? apply_number_i : read_number_i),
      .data_o          (read_word[copy])
    );
  end

  // The word that the job in cycle 3 of the cycle before has made.
  block_word_t kept_word_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[3]) begin
      kept_word_q <= made_word;
    end
  end

  // Cycle 0: which of the three jobs before is of the same block, and which entries get bounds.
  logic [3:1]         same_q;
  logic               stored_q, cleared_q;
  hi_z_update_t       update1_q;
  logic [Entries-1:0] put, put1_q, put2_q;
  code_t              clear_code_q;

  for (genvar i = 0; i < Entries; i++) begin : gen_put
    assign put[i] = apply_tile_i[i/ZParts] & apply_update_i.touched[i%ZParts];
  end

  always_ff @(posedge clk_i) begin
    if (apply_i) begin
      for (int unsigned i = 1; i < 4; i++) begin
        same_q[i] <= valid_q[i] && number_q[i] == apply_number_i;
      end
      update1_q    <= apply_update_i;
      put1_q       <= put;
      clear_code_q <= apply_clear_code_i;
      stored_q     <= stored[0];
      cleared_q    <= cleared[0];
    end
  end

  // Cycle 1.
  block_word_t word1;
  codes_t      least1, most1, made_least_q, made_most_q;

  assign word1 = same_q[3] ? kept_word_q : word_as(stored_q, cleared_q, read_word[0], clear_code_q);

  for (genvar i = 0; i < Entries; i++) begin : gen_code
    assign least1[i] = first_code(word1.base, word1.shift, word1.least[i]);
    assign most1[i]  = last_code(word1.base, word1.shift, word1.most[i]);
  end

  // Of a word from memory what stays spans steps, of one that a job has just made it spans codes.
  bound_t first_step, last_step;
  codes_t put_least, put_most, span_least, span_most;
  code_t  first_made, last_made, below;

  hi_z_span #(
    .Width   (Bits),
    .Entries (Entries)
  ) u_steps (
    .leave_out_i (put1_q),
    .least_i     (word1.least),
    .most_i      (word1.most),
    .first_o     (first_step),
    .last_o      (last_step)
  );

  assign span_least = same_q[1] ? put_least : made_least_q;
  assign span_most  = same_q[1] ? put_most : made_most_q;

  hi_z_span #(
    .Width   (CodeBits),
    .Entries (Entries)
  ) u_codes (
    .leave_out_i (put1_q),
    .least_i     (span_least),
    .most_i      (span_most),
    .first_o     (first_made),
    .last_o      (last_made)
  );

  codes_t             least2_q, most2_q, rounded_least, rounded_most;
  code_t              first2_q, last2_q, first;
  logic [ZParts-1:0]  part2_q;
  code_t [ZParts-1:0] part_least2_q, part_most2_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      put2_q        <= put1_q;
      part2_q       <= update1_q.touched;
      part_least2_q <= update1_q.least;
      part_most2_q  <= update1_q.most;
      if (same_q[1]) begin
        // The least of what is rounded is the least, rounded.
        least2_q <= rounded_least;
        most2_q  <= rounded_most;
        first2_q <= first_made & ~below;
        last2_q  <= last_made | below;
      end else if (same_q[2]) begin
        least2_q <= made_least_q;
        most2_q  <= made_most_q;
        first2_q <= first_made;
        last2_q  <= last_made;
      end else begin
        least2_q <= least1;
        most2_q  <= most1;
        first2_q <= first_code(word1.base, word1.shift, first_step);
        last2_q  <= last_code(word1.base, word1.shift, last_step);
      end
    end
  end

  // Cycle 2.
  hi_z_word #(
    .Bits (Bits)
  ) u_word (
    .least_i     (least2_q),
    .most_i      (most2_q),
    .first_i     (first2_q),
    .last_i      (last2_q),
    .put_i       (put2_q),
    .put_part_i  (part2_q),
    .put_least_i (part_least2_q),
    .put_most_i  (part_most2_q),
    .least_o     (put_least),
    .most_o      (put_most),
    .first_o     (first),
    .below_o     (below)
  );

  for (genvar i = 0; i < Entries; i++) begin : gen_round
    assign rounded_least[i] = put_least[i] & ~below;
    assign rounded_most[i]  = put_most[i] | below;
  end

  code_t made_base_q, made_below_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      made_least_q <= rounded_least;
      made_most_q  <= rounded_most;
      made_base_q  <= first & ~below;
      made_below_q <= below;
    end
  end

  // Cycle 3: the bits below a step are so many; of steps the low bits tell how far they are from the first.
  word_shift_t          shift;
  bound_t               start;
  bound_t [Entries-1:0] least_steps, most_steps;

  always_comb begin
    shift = '0;
    for (int unsigned i = 0; i < CodeBits; i++) begin
      if (made_below_q[i]) begin
        shift = word_shift_t'(i + 1);
      end
    end
  end

  assign start = bound_t'(made_base_q >> shift);

  for (genvar i = 0; i < Entries; i++) begin : gen_step
    assign least_steps[i] = bound_t'(made_least_q[i] >> shift) - start;
    assign most_steps[i]  = bound_t'(made_most_q[i] >> shift) - start;
  end

  assign made_word = '{base: made_base_q, shift: shift, least: least_steps, most: most_steps};

  // A block in its cycle 2. Of the parts of a tile only the lowest and the highest count.
  block_word_t word;
  logic        made;

  assign made = valid_q[3] && number_q[3] == number_i;
  assign word = valid_q[4] && number_q[4] == number_i
                ? kept_word_q : word_as(stored[1], cleared[1], read_word[1], clear_code_i);

  for (genvar i = 0; i < BlockTiles; i++) begin : gen_tile
    bound_t least_step, most_step;
    code_t  made_least, made_most;

    always_comb begin
      least_step = word.least[i*ZParts];
      most_step  = word.most[i*ZParts];
      made_least = made_least_q[i*ZParts];
      made_most  = made_most_q[i*ZParts];
      for (int unsigned part = 1; part < ZParts; part++) begin
        automatic int unsigned at = i * ZParts + part;
        least_step = word.least[at] < least_step ? word.least[at] : least_step;
        most_step  = word.most[at] > most_step ? word.most[at] : most_step;
        made_least = made_least_q[at] < made_least ? made_least_q[at] : made_least;
        made_most  = made_most_q[at] > made_most ? made_most_q[at] : made_most;
      end
    end
    assign least_o[i] = made ? made_least : first_code(word.base, word.shift, least_step);
    assign most_o[i]  = made ? made_most : last_code(word.base, word.shift, most_step);
  end

endmodule
