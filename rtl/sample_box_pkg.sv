// The least box that holds the samples of a pixel, and their places on the sub-pixel grid. All of it is constant.

package sample_box_pkg;
  import raster_pkg::*;
  import sample_pkg::*;

  // The least and the most of all samples, in sixteenths from the top left corner of the pixel.
  function automatic grid_t least(bit in_y);
    least = position(0, in_y);
    for (int unsigned i = 1; i < PixelSamples; i++) begin
      least = position(i, in_y) < least ? position(i, in_y) : least;
    end
  endfunction
  function automatic grid_t most(bit in_y);
    most = position(0, in_y);
    for (int unsigned i = 1; i < PixelSamples; i++) begin
      most = position(i, in_y) > most ? position(i, in_y) : most;
    end
  endfunction

  localparam grid_t LeastX = least(1'b0);
  localparam grid_t MostX = most(1'b0);
  localparam grid_t LeastY = least(1'b1);
  localparam grid_t MostY = most(1'b1);

  // Sixteenths as steps of the sub-pixel grid.
  function automatic logic [SubPixelBits-1:0] sub_pixels(grid_t at);
    return SubPixelBits'(at) << (SubPixelBits - SampleGridLog2);
  endfunction
endpackage : sample_box_pkg
