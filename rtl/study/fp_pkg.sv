// What the floating-point units of the precision study share.

package fp_pkg;

  /// Zeros above the top bit of the low `width` bits of a value; `width` where there is no bit. A tree of powers of two.
  function automatic logic [7:0] leading_zeros(logic [127:0] value, int unsigned width);
    logic [127:0] moved;
    logic [7:0]   zeros;
    moved = value << (128 - width);
    zeros = '0;
    for (int k = 6; k >= 0; k--) begin
      if (moved >> (128 - (1 << k)) == '0) begin
        moved    = moved << (1 << k);
        zeros[k] = 1'b1;
      end
    end
    return value == '0 ? 8'(width) : zeros;
  endfunction

endpackage
