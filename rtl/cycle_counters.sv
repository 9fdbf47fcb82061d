// Counts what every stage spends its cycles on, and the cycles in which memory moves data.

module cycle_counters
  import raster_pkg::*;
#(
  /// Bits of a counter: 50 hold any frame (docs/timing.md).
  parameter int unsigned CounterBits = 50
) (
  input  logic                                          clk_i,
  input  logic                                          rst_ni,

  /// This cycle counts.
  input  logic                                          count_i,
  input  logic [StageCount-1:0] [ActivityBits-1:0]      activity_i,
  input  logic                                          read_busy_i,
  input  logic                                          write_busy_i,

  /// Stage and activity; of stage StageCount, which is memory, 0 reads and 1 writes. 0 where there is no counter.
  input  logic [$clog2(StageCount+1)+ActivityBits-1:0] select_i,
  /// One cycle after select_i: the counter as it was in the cycle of select_i.
  output logic [CounterBits-1:0]                        count_o
);

  localparam int unsigned StageBits = $clog2(StageCount + 1);
  localparam int unsigned IndexBits = $clog2(StageCount);
  typedef logic [CounterBits-1:0] count_t;

  // One write port a stage: it spends a cycle on one thing. No activity has a number of ActivityCount or above.
  count_t stage_q [StageCount][ActivityCount];
  count_t read_q, write_q;

  always_ff @(posedge clk_i) begin
    for (int unsigned stage = 0; stage < StageCount; stage++) begin
      if (!rst_ni) begin
        for (int unsigned activity = 0; activity < ActivityCount; activity++) begin
          stage_q[stage][activity] <= '0;
        end
      end else if (count_i) begin
        stage_q[stage][activity_i[stage]] <= stage_q[stage][activity_i[stage]] + count_t'(1);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      read_q  <= '0;
      write_q <= '0;
    end else begin
      if (count_i && read_busy_i) begin
        read_q <= read_q + count_t'(1);
      end
      if (count_i && write_busy_i) begin
        write_q <= write_q + count_t'(1);
      end
    end
  end

  logic [StageBits-1:0]    stage;
  logic [ActivityBits-1:0] activity;
  assign {stage, activity} = select_i;

  count_t count_d, count_q;

  always_comb begin
    count_d = '0;
    if (stage < StageBits'(StageCount) && activity < ActivityBits'(ActivityCount)) begin
      count_d = stage_q[stage[IndexBits-1:0]][activity];
    end else if (stage == StageBits'(StageCount)) begin
      count_d = activity == '0 ? read_q : activity == ActivityBits'(1) ? write_q : '0;
    end
  end

  always_ff @(posedge clk_i) begin
    count_q <= count_d;
  end

  assign count_o = count_q;

endmodule
