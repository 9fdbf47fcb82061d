// Lines of depth and the forms in which they are coded: model/halfspace/units/z_codec.hpp.

package z_codec_pkg;

  import raster_pkg::*;

  // A line: a part of a tile, TileSize samples wide.
  parameter int unsigned PartQuads = TileQuads / ZParts;
  parameter int unsigned Samples = MaskBits / ZParts;
  parameter int unsigned Height = TileSize / ZParts;
  parameter int unsigned LineBytes = 4 * MaskBits / ZParts;
  parameter int unsigned DataBits = 8 * LineBytes;

  typedef logic [CodeBits-1:0] code_t;
  typedef logic [PartQuads-1:0] [3:0] [CodeBits-1:0] quads_t; // codes by quad
  typedef logic [Samples-1:0] [CodeBits-1:0] rows_t;            // in memory's order
  typedef logic [DataBits-1:0] data_t;
  typedef logic [$clog2(MostCodedShift+1)-1:0] coded_shift_t;

  function automatic int unsigned quad_of(int unsigned place);
    return place / TileSize / 2 * (TileSize / 2) + place % TileSize / 2;
  endfunction
  function automatic int unsigned sample_of(int unsigned place);
    return place / TileSize % 2 * 2 + place % 2;
  endfunction

  // Sizes. A line in halves has codes of 16 bits, half as many bytes.
  function automatic int unsigned code_bits(bit half);
    return half ? CodeBits / 2 : CodeBits;
  endfunction
  function automatic int unsigned coded_bytes(bit half, int unsigned shift);
    return (half ? LineBytes / 2 : LineBytes) >> shift;
  endfunction
  function automatic bit is_coded(bit half, int unsigned shift);
    return shift != 0 && coded_bytes(half, shift) >= LeastCodedBytes;
  endfunction

  // Bits of a sample's offset, 0 where there is no such size.
  function automatic int unsigned plane_bits(bit half, int unsigned shift);
    return is_coded(half, shift)
        ? (8 * coded_bytes(half, shift) - 1 - 3 * code_bits(half)) / Samples : 0;
  endfunction
  function automatic int unsigned ends_bits(bit half, int unsigned shift);
    return is_coded(half, shift)
        ? (8 * coded_bytes(half, shift) - 1 - 2 * code_bits(half)) / Samples - 1 : 0;
  endfunction

  // The largest of them; a line in halves has fewer for its size.
  parameter int unsigned MostPlaneBits = plane_bits(1'b0, 1);
  parameter int unsigned MostEndsBits = ends_bits(1'b0, 1);

  // A code of 16 bits as a signed number of 32.
  function automatic code_t extended(code_t code, logic half);
    return half ? code_t'(signed'(code[CodeBits/2-1:0])) : code;
  endfunction

  // floor(along step / 2^log2) modulo 2^CodeBits: how far a plane has risen `along` samples from the first, of which
  // 2^log2 rise by `step`. `along` is a constant, so this is an addition or two.
  function automatic code_t rise(code_t step, int unsigned along, int unsigned log2);
    logic [CodeBits+TileLog2-1:0] wide, sum;
    wide = (CodeBits + TileLog2)'(signed'(step));
    sum  = '0;
    for (int unsigned k = 0; k < TileLog2; k++) begin
      if (along[k]) begin
        sum += wide << k;
      end
    end
    return code_t'(sum >> log2);
  endfunction
  // Of the two ways.
  parameter int unsigned HalfWidthLog2 = TileLog2 - 1;
  parameter int unsigned HalfHeightLog2 = $clog2(Height) - 1;

endpackage : z_codec_pkg
