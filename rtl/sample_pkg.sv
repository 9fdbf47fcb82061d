// Where the samples of a pixel are, in sixteenths from its centre. All of it is constant.

package sample_pkg;
  import raster_pkg::*;

  localparam int unsigned SampleGridLog2 = 4;
  // One sample, at the centre: nothing is moved.
  localparam bit AtCentre = PixelSamples == 1 && SamplePositions[7:0] == 8'h88;
  // Bits of a register that holds the number of a sample.
  localparam int unsigned SampleBits = SampleLog2 == 0 ? 1 : SampleLog2;

  typedef logic [SampleBits-1:0] sample_t;
  typedef logic [SampleGridLog2-1:0] grid_t;
  typedef logic signed [SampleGridLog2-1:0] from_centre_t;
  // What E changes by on the way to a sample, in 1/2^SampleGridLog2 of a step for a pixel: half a pixel in x and y at most.
  typedef logic signed [StepBits+SampleGridLog2:0] to_sample_t;

  // Of sample i, in sixteenths from the top left corner of the pixel: in x, or in y.
  function automatic grid_t position(int unsigned i, bit in_y);
    return in_y ? SamplePositions[8*i+:4] : SamplePositions[8*i+4+:4];
  endfunction

  // The same from the centre.
  function automatic from_centre_t from_centre(grid_t at);
    return from_centre_t'({~at[SampleGridLog2-1], at[SampleGridLog2-2:0]});
  endfunction

  // `count` steps, as a sum of shifted ones.
  function automatic to_sample_t sixteenths(step_t step, from_centre_t count);
    sixteenths = count[SampleGridLog2-1] ? -(to_sample_t'(step) <<< (SampleGridLog2 - 1)) : '0;
    for (int unsigned i = 0; i < SampleGridLog2 - 1; i++) begin
      sixteenths = sixteenths + (count[i] ? to_sample_t'(step) <<< i : '0);
    end
  endfunction
endpackage : sample_pkg
