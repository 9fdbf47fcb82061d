// The fill buffers of the z cache: lines that memory was asked for, from their data on until the test takes them. Memory
// answers in order, so only one line is in the making.

module z_fill_buffers
  import raster_pkg::*;
  import z_codec_pkg::*;
#(
  /// Lines, ZParts or more.
  parameter int unsigned MissesInFlight = 16,
  /// Bytes that memory reads in a cycle: a power of two.
  parameter int unsigned ReadBytes = 64,
  /// 1: lines are coded in memory, and decoded in ZDecodeLatency + 1 cycles before they count as filled.
  parameter bit Compression = 1'b0,
  localparam int unsigned FillBits = 8 * (ReadBytes < LineBytes ? ReadBytes : LineBytes),
  localparam int unsigned CountBits = $clog2(MissesInFlight + 1)
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // A line that was asked for; there is a buffer for it.
  input  logic                 request_i,
  input  logic                 request_half_i,
  input  coded_shift_t         request_shift_i,

  // Memory's data.
  input  logic                 fill_valid_i,
  input  logic [FillBits-1:0]  fill_data_i,

  // The oldest lines: those of the parts that want one, in order of parts. They leave with take_i.
  input  logic                 take_i,
  input  logic [ZParts-1:0]    wanted_i,
  output logic                 there_o, // all of them
  output quads_t [ZParts-1:0]  lines_o
);

  localparam int unsigned PointerBits = MissesInFlight > 1 ? $clog2(MissesInFlight) : 1;
  localparam int unsigned MostBeats = LineBytes > ReadBytes ? LineBytes / ReadBytes : 1;
  localparam int unsigned BeatBits = MostBeats > 1 ? $clog2(MostBeats) : 1;

  typedef logic [PointerBits-1:0] pointer_t;
  typedef logic [CountBits-1:0]   count_t;
  typedef logic [BeatBits-1:0]    beat_t;

  function automatic pointer_t after(pointer_t pointer, int unsigned steps);
    automatic int unsigned sum = int'(pointer) + steps;
    return pointer_t'(sum >= MissesInFlight ? sum - MissesInFlight : sum);
  endfunction

  typedef struct packed {
    logic         half;
    coded_shift_t shift;
  } form_t;

  form_t    forms_q [MissesInFlight];
  form_t    form;
  // Next to be asked for, to come, to be filled, to be taken.
  pointer_t request_q, fill_q, filled_q, taken_q;
  beat_t    beat_q, last_beat;
  logic     fill_end, filled;                     // the last data of a line; a line is there
  quads_t   lines_q [MissesInFlight];
  quads_t   line;

  assign form = forms_q[fill_q];

  always_comb begin
    last_beat = '0;
    for (int unsigned shift = 0; shift <= (Compression ? MostCodedShift : 0); shift++) begin
      for (int unsigned half = 0; half < 2; half++) begin
        if (form.half == half[0] && form.shift == coded_shift_t'(shift)) begin
          last_beat = coded_bytes(half[0], shift) > ReadBytes
              ? beat_t'(coded_bytes(half[0], shift) / ReadBytes - 1) : '0;
        end
      end
    end
  end
  assign fill_end = fill_valid_i && beat_q == last_beat;

  // The line in the making, with the data of this cycle.
  data_t data_q, data;
  always_comb begin
    data = data_q;
    for (int unsigned i = 0; i < MostBeats; i++) begin
      if (beat_q == beat_t'(i)) begin
        data[i*FillBits+:FillBits] = fill_data_i;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (fill_valid_i) begin
      data_q <= data;
    end
  end

  if (Compression) begin : gen_decoder
    logic  whole_q;
    form_t form_q;

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        whole_q <= 1'b0;
      end else begin
        whole_q <= fill_end;
      end
    end
    always_ff @(posedge clk_i) begin
      if (fill_end) begin
        form_q <= form;
      end
    end

    z_decoder u_decoder (
      .clk_i   (clk_i),
      .rst_ni  (rst_ni),
      .valid_i (whole_q),
      .half_i  (form_q.half),
      .shift_i (form_q.shift),
      .data_i  (data_q),
      .valid_o (filled),
      .codes_o (line)
    );
  end else begin : gen_plain
    assign filled = fill_end;
    always_comb begin
      for (int unsigned i = 0; i < Samples; i++) begin
        line[quad_of(i)][sample_of(i)] =
            form.half ? code_t'(data[i*(CodeBits/2)+:CodeBits/2]) : data[i*CodeBits+:CodeBits];
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (request_i) begin
      forms_q[request_q] <= '{half: request_half_i, shift: request_shift_i};
    end
    if (filled) begin
      lines_q[filled_q] <= line;
    end
  end

  // Of each part the buffer, after those of the parts before it.
  count_t full_q, wanted;
  for (genvar p = 0; p < ZParts; p++) begin : gen_part
    localparam logic [ZParts-1:0] Before = ZParts'((1 << p) - 1);
    always_comb begin
      automatic int unsigned earlier = 0;
      for (int unsigned i = 0; i < ZParts; i++) begin
        earlier += Before[i] && wanted_i[i] ? 1 : 0;
      end
      lines_o[p] = lines_q[after(taken_q, earlier)];
    end
  end

  always_comb begin
    wanted = '0;
    for (int unsigned p = 0; p < ZParts; p++) begin
      wanted += count_t'(wanted_i[p]);
    end
  end
  assign there_o = full_q >= wanted;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      request_q <= '0;
      fill_q    <= '0;
      filled_q  <= '0;
      taken_q   <= '0;
      beat_q    <= '0;
      full_q    <= '0;
    end else begin
      if (request_i) begin
        request_q <= after(request_q, 1);
      end
      if (fill_valid_i) begin
        beat_q <= fill_end ? '0 : beat_q + beat_t'(1);
      end
      if (fill_end) begin
        fill_q <= after(fill_q, 1);
      end
      if (filled) begin
        filled_q <= after(filled_q, 1);
      end
      if (take_i) begin
        taken_q <= after(taken_q, int'(wanted));
      end
      full_q <= full_q + count_t'(filled) - (take_i ? wanted : '0);
    end
  end

endmodule
