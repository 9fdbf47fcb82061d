// One edge on its way from a block to a tile of it: two registers, in step with those of tile_walker.
//
// E is the same modulo 2^SubPixelBits at all pixel centres, so what moves is floor(E / 2^SubPixelBits), which a pixel
// changes by a or b. An edge function is linear: over the samples of a tile it is least at a corner, and the signs of a
// and b say at which. So the test for the accept bit is one adder, of which only the sign is used.
//
// Where samples are not at the centres, E also moves to the sample of the job: from there it is again the same modulo
// 2^SubPixelBits at that sample of all pixels.

module tile_edge
  import raster_pkg::*;
  import sample_pkg::*;
#(
  /// 0: no tile is found to be inside.
  parameter bit TrivialAccept = 1'b1,
  /// Bits of a tile's column or row in its block. Follows from the package.
  localparam int unsigned RowBits = BlockLog2 - TileLog2
) (
  input  logic               clk_i,

  // First register: the edge at the centre of the block's top left pixel, and which sample.
  input  logic               picked_valid_i,
  input  edge_t              edge_i,
  input  step_t              a_i,
  input  step_t              b_i,
  input  sample_t            sample_i,

  // Second register: which tile of the block.
  input  logic               placed_valid_i,
  input  logic [RowBits-1:0] tile_x_i,
  input  logic [RowBits-1:0] tile_y_i,

  // From the second register: the edge at the tile's top left sample.
  output edge_t              edge_o,
  output step_t              a_o,
  output step_t              b_o,
  output logic               accept_o // all samples of the tile are inside
);

  localparam int unsigned SumBits = StepBits + 1;
  localparam int unsigned LeastBits = SumBits + TileLog2;

  typedef logic signed [PixelEdgeBits-1:0] pixel_edge_t;
  typedef logic signed [SumBits-1:0] sum_t;
  typedef logic signed [LeastBits-1:0] least_t;
  typedef logic [RowBits-1:0] place_t;

  typedef struct packed {
    pixel_edge_t             e;
    logic [SubPixelBits-1:0] sub_pixel;
    step_t                   a;
    step_t                   b;
  } edge_at_t;

  edge_at_t                        block_q, tile_q;
  logic signed [PixelEdgeBits-1:0] at_tile; // at the centre
  edge_t                           at_sample;

  always_ff @(posedge clk_i) begin
    if (picked_valid_i) begin
      block_q <= {edge_i, a_i, b_i};
    end
  end

  // `tiles` times the step of a tile, as a sum of shifted ones.
  function automatic pixel_edge_t across(step_t step, place_t tiles);
    across = '0;
    for (int unsigned i = 0; i < RowBits; i++) begin
      across = across + (tiles[i] ? pixel_edge_t'(step) <<< (TileLog2 + i) : '0);
    end
  endfunction

  // To where E is least in a tile: TileSize - 1 times the sum of the steps that go down.
  function automatic least_t to_least(step_t a, step_t b);
    sum_t falling = (a[StepBits-1] ? sum_t'(a) : '0) + (b[StepBits-1] ? sum_t'(b) : '0);
    return (least_t'(falling) <<< TileLog2) - least_t'(falling);
  endfunction

  assign at_tile = block_q.e + across(block_q.a, tile_x_i) + across(block_q.b, tile_y_i);

  if (AtCentre) begin : gen_centre
    assign at_sample = {at_tile, block_q.sub_pixel};

    logic unused_sample;
    assign unused_sample = ^sample_i;
  end else begin : gen_samples
    to_sample_t to_sample_q;
    always_ff @(posedge clk_i) begin
      if (picked_valid_i) begin
        to_sample_q <= sixteenths(a_i, from_centre(position(32'(sample_i), 1'b0)))
                       + sixteenths(b_i, from_centre(position(32'(sample_i), 1'b1)));
      end
    end
    assign at_sample = edge_t'({at_tile, block_q.sub_pixel})
                       + (edge_t'(to_sample_q) <<< (SubPixelBits - SampleGridLog2));
  end

  least_t least_q;

  always_ff @(posedge clk_i) begin
    if (placed_valid_i) begin
      tile_q  <= '{
        e:         at_sample[EdgeBits-1:SubPixelBits],
        sub_pixel: at_sample[SubPixelBits-1:0],
        a:         block_q.a,
        b:         block_q.b
      };
      least_q <= to_least(block_q.a, block_q.b);
    end
  end

  logic inside_all;
  assign inside_all = tile_q.e + pixel_edge_t'(least_q) >= $signed(PixelEdgeBits'(0));

  assign edge_o   = {tile_q.e, tile_q.sub_pixel};
  assign a_o      = tile_q.a;
  assign b_o      = tile_q.b;
  assign accept_o = TrivialAccept & inside_all;

endmodule
