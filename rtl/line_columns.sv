// The columns and rows of pixels of a thin line: model/halfspace/units/thin_line.cpp without its edges.
//
// Columns are rows where the line is y-major; u is the coordinate along the major axis, v the other. Three registers, in
// step with those of setup_cull: floors and differences; the major axis; the pixels, cut to the bounds of the draw.
// Nothing is multiplied or divided: of a column that the line enters or leaves only whether an end is inside a diamond is
// asked, and the pixels of all columns are between those of the ends.

module line_columns
  import raster_pkg::*;
  import setup_pkg::*;
(
  input  logic                     clk_i,
  input  logic                     rst_ni,

  input  logic                     valid_i,
  input  coord_t [1:0]             x_i, // of the start, and of the end
  input  coord_t [1:0]             y_i,
  input  line_rule_e               rule_i,
  input  logic [LineWidthBits-1:0] width_i,
  input  bounds_t                  limits_i, // of the draw

  // Three cycles later. Whether there are pixels is for the reader of the bounds to say: the last may be less than the
  // first. `length` is along the major axis, before the ends of midpoint and DDA move to pixel centres.
  output line_t                    line_o,
  output logic [CoordBits-1:0]     length_o,
  output logic                     drawn_o,
  output bounds_t                  bounds_o
);

  localparam int unsigned ReachBits = StepBits - SubPixelBits;
  localparam int unsigned PartBits = SubPixelBits;

  typedef logic signed [ReachBits-1:0] reach_t;
  typedef logic [PartBits-1:0] part_t;

  localparam part_t HalfPart = part_t'(1) << (SubPixelBits - 1);

  logic [2:1] valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[1], valid_i};
    end
  end

  // A coordinate as the pixel whose centre is the last not behind it, and the way from there. Midpoint and DDA take the
  // centre of the coordinate's pixel.
  typedef struct packed {
    reach_t pixel;
    part_t  part;
  } place_t;

  function automatic place_t place(coord_t c, logic joined);
    reach_t whole = reach_t'(c >>> SubPixelBits);
    place_t p;
    p.pixel = joined || c[SubPixelBits-1] ? whole : whole - reach_t'(1);
    p.part  = joined ? '0 : c[SubPixelBits-1:0] ^ HalfPart;
    return p;
  endfunction

  function automatic step_t difference(coord_t to, coord_t from, logic joined);
    step_t cut_to = step_t'(to);
    step_t cut_from = step_t'(from);
    if (joined) begin
      cut_to[SubPixelBits-1:0]   = '0;
      cut_from[SubPixelBits-1:0] = '0;
    end
    return cut_to - cut_from;
  endfunction

  // First register. Index 0 is the start, 1 the end.
  typedef struct packed {
    line_rule_e               rule;
    logic [LineWidthBits-1:0] width;
    place_t [1:0]             x;
    place_t [1:0]             y;
    step_t                    dx;
    step_t                    dy;
    step_t                    whole_dx;
    step_t                    whole_dy;
    bounds_t                  limits;
  } measured_t;

  measured_t measured_q;

  logic joined;
  assign joined = joins_pixels(rule_i);

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      measured_q.rule     <= rule_i;
      measured_q.width    <= width_i;
      measured_q.dx       <= difference(x_i[1], x_i[0], joined);
      measured_q.dy       <= difference(y_i[1], y_i[0], joined);
      measured_q.whole_dx <= difference(x_i[1], x_i[0], 1'b0);
      measured_q.whole_dy <= difference(y_i[1], y_i[0], 1'b0);
      measured_q.limits   <= limits_i;
      for (int unsigned i = 0; i < 2; i++) begin
        measured_q.x[i] <= place(x_i[i], joined);
        measured_q.y[i] <= place(y_i[i], joined);
      end
    end
  end

  // Second register: the major axis, and half-way between two pixels which one the line takes.
  typedef logic signed [StepBits:0] sum_t;

  typedef struct packed {
    line_rule_e               rule;
    line_t                    line;
    logic [LineWidthBits-1:0] width;
    place_t [1:0]             u;
    place_t [1:0]             v;
    step_t                    length; // of either sign
    logic                     same;   // both ends are one point
    bounds_t                  limits;
  } turned_t;

  turned_t turned_q;

  sum_t sum, less;
  logic x_major, rises, falls;
  assign sum     = sum_t'(measured_q.dx) + sum_t'(measured_q.dy);
  assign less    = sum_t'(measured_q.dx) - sum_t'(measured_q.dy);
  assign x_major = sum == '0 || less == '0 || sum[StepBits] == less[StepBits];
  assign falls   = x_major ? measured_q.dy[StepBits-1] : measured_q.dx[StepBits-1];
  assign rises   = measured_q.dy != '0 && measured_q.dx[StepBits-1] == measured_q.dy[StepBits-1];

  // To the pixel of larger v. The ends of Vulkan's lines are moved by (-e, -e^2); midpoint stays at the start's pixel;
  // Direct3D's diamonds have their bottom and right corners.
  function automatic logic goes_up(line_rule_e rule, logic major_x, logic both_rise,
                                   logic v_less);
    unique case (rule)
      LineBresenham: return major_x && both_rise;
      LineMidpoint:  return v_less;
      LineDda:       return 1'b1;
      default:       return 1'b0;
    endcase
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      turned_q.rule           <= measured_q.rule;
      turned_q.line.x_major   <= x_major;
      turned_q.line.left      <= measured_q.dx[StepBits-1];
      turned_q.line.up        <= measured_q.dy[StepBits-1];
      turned_q.line.ties_up   <= goes_up(measured_q.rule, x_major, rises, falls);
      turned_q.width          <= measured_q.width;
      turned_q.u              <= x_major ? measured_q.x : measured_q.y;
      turned_q.v              <= x_major ? measured_q.y : measured_q.x;
      turned_q.length         <= x_major ? measured_q.whole_dx : measured_q.whole_dy;
      turned_q.same           <= measured_q.dx == '0 && measured_q.dy == '0;
      turned_q.limits         <= measured_q.limits;
    end
  end

  // Third register. Of an end: v of the point that is looked at for the pixel of least v, which lies half of the rest of
  // the width before it, and for that of most v, as far behind.
  localparam int unsigned WideBits = SubPixelBits + LineWidthBits + 1;

  typedef logic signed [WideBits-1:0] wide_t;

  logic   backward, moved;
  wide_t  rest; // half of the width less a pixel, in sub-pixels
  assign backward = turned_q.line.x_major ? turned_q.line.left : turned_q.line.up;
  assign moved    = turned_q.rule == LineBresenham ||
                    (joins_pixels(turned_q.rule) && !backward);
  assign rest     = wide_t'({turned_q.width - LineWidthBits'(1), {(SubPixelBits - 1){1'b0}}});

  // From the centre of the place's pixel to the middle between two pixels is half a pixel; where ties go down, the pixel
  // begins a sub-pixel behind it.
  function automatic wide_t from_pixel(part_t part, wide_t width_rest, logic ties_up);
    return wide_t'({1'b0, part}) + wide_t'({1'b0, HalfPart}) + width_rest
           - wide_t'({1'b0, !ties_up});
  endfunction

  function automatic reach_t pixel_at(place_t p, wide_t width_rest, logic ties_up);
    wide_t way = from_pixel(p.part, width_rest, ties_up) >>> SubPixelBits;
    return p.pixel + reach_t'(way);
  endfunction

  // Whether the diamond of a pixel holds an end: that of the column of its place, or of the next (`next`), at the row in
  // which the end is.
  typedef logic signed [PartBits+1:0] offset_t;

  function automatic offset_t magnitude(offset_t value);
    return value[PartBits+1] ? -value : value;
  endfunction

  function automatic logic holds(part_t u, part_t v, logic next, wide_t width_rest,
                                 line_rule_e rule, logic major_x, logic ties_up);
    localparam offset_t Half = offset_t'({1'b0, HalfPart});
    localparam offset_t One = offset_t'({2'b01, {PartBits{1'b0}}});
    part_t   in_row = part_t'(from_pixel(v, -width_rest, ties_up));
    offset_t off_u = offset_t'({1'b0, u}) - (next ? One : '0);
    offset_t off_v = offset_t'({1'b0, in_row}) - Half + offset_t'({1'b0, !ties_up});
    offset_t distance = magnitude(off_u) + magnitude(off_v);
    offset_t x = major_x ? off_u : off_v;
    offset_t y = major_x ? off_v : off_u;
    logic    right = !x[PartBits+1] && x != '0;
    logic    below = !y[PartBits+1] && y != '0;
    logic    owned = rule == LineBresenham ? right : below || (!major_x && y == '0 && right);
    return distance < Half || (distance == Half && owned);
  endfunction

  // The column of the first middle that is not before an end, and of the last not behind it: on a middle the line that is
  // moved is before it.
  reach_t [1:0] after, not_after;
  logic   [1:0] on_middle;
  reach_t       start, stop, ahead;
  logic         has_ahead, ends_inside;

  always_comb begin
    for (int unsigned i = 0; i < 2; i++) begin
      on_middle[i] = turned_q.u[i].part == '0;
      after[i]     = on_middle[i] ? turned_q.u[i].pixel : turned_q.u[i].pixel + reach_t'(1);
      not_after[i] = on_middle[i] && moved ? turned_q.u[i].pixel - reach_t'(1)
                                           : turned_q.u[i].pixel;
    end
  end

  assign start  = backward ? not_after[0] : after[0];
  assign stop   = backward ? after[1] : not_after[1];
  assign ahead = backward ? not_after[0] + reach_t'(1) : after[0] - reach_t'(1);

  logic held_at_start, held_at_stop;
  logic [1:0] end_held; // by the column of its place, by the next
  assign end_held[0] = holds(turned_q.u[1].part, turned_q.v[1].part, 1'b0, rest, turned_q.rule,
            turned_q.line.x_major, turned_q.line.ties_up);
  assign end_held[1] = holds(turned_q.u[1].part, turned_q.v[1].part, 1'b1, rest, turned_q.rule,
            turned_q.line.x_major, turned_q.line.ties_up);

  // A column that is farther from an end than the two about it holds none.
  assign held_at_start = ahead == turned_q.u[0].pixel
                         ? holds(turned_q.u[0].part, turned_q.v[0].part, 1'b0, rest, turned_q.rule,
            turned_q.line.x_major, turned_q.line.ties_up)
                         : ahead == turned_q.u[0].pixel + reach_t'(1) &&
                           holds(turned_q.u[0].part, turned_q.v[0].part, 1'b1, rest, turned_q.rule,
            turned_q.line.x_major, turned_q.line.ties_up);
  assign has_ahead    = held_at_start && !joins_pixels(turned_q.rule) &&
                         !(ahead == turned_q.u[1].pixel && end_held[0]) &&
                         !(ahead == turned_q.u[1].pixel + reach_t'(1) && end_held[1]);
  assign held_at_stop  = joins_pixels(turned_q.rule) ? backward
                         : stop == turned_q.u[1].pixel ? end_held[0]
                         : stop == turned_q.u[1].pixel + reach_t'(1) && end_held[1];
  assign ends_inside   = held_at_stop && (backward ? stop <= start : stop >= start);

  reach_t start_column, first_column, last_column, v_low, v_high;
  reach_t x_low, x_high, y_low, y_high;
  place_t low, high;
  logic   v_falls;
  assign start_column = has_ahead ? ahead : start;
  assign first_column = backward ? stop + reach_t'({1'b0, ends_inside}) : start_column;
  assign last_column  = backward ? start_column : stop - reach_t'({1'b0, ends_inside});
  assign v_falls      = turned_q.line.x_major ? turned_q.line.up : turned_q.line.left;
  assign low          = turned_q.v[v_falls];
  assign high         = turned_q.v[!v_falls];
  assign v_low        = pixel_at(low, -rest, turned_q.line.ties_up);
  assign v_high       = pixel_at(high, rest, turned_q.line.ties_up);

  assign x_low  = turned_q.line.x_major ? first_column : v_low;
  assign x_high = turned_q.line.x_major ? last_column : v_high;
  assign y_low  = turned_q.line.x_major ? v_low : first_column;
  assign y_high = turned_q.line.x_major ? v_high : last_column;

  function automatic reach_t at_least(reach_t pixel, logic [PixelBits-1:0] limit);
    reach_t bound = reach_t'({1'b0, limit});
    return pixel > bound ? pixel : bound;
  endfunction

  function automatic reach_t at_most(reach_t pixel, logic [PixelBits-1:0] limit);
    reach_t bound = reach_t'({1'b0, limit});
    return pixel < bound ? pixel : bound;
  endfunction

  typedef struct packed {
    line_t                line;
    logic [CoordBits-1:0] length;
    logic                 same;
    reach_t               x_first;
    reach_t               x_last;
    reach_t               y_first;
    reach_t               y_last;
  } sized_t;

  sized_t sized_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      sized_q.line    <= turned_q.line;
      sized_q.length  <= CoordBits'(turned_q.length[StepBits-1] ? -turned_q.length
                                                                : turned_q.length);
      sized_q.same    <= turned_q.same;
      sized_q.x_first <= at_least(x_low, turned_q.limits.x_first);
      sized_q.x_last  <= at_most(x_high, turned_q.limits.x_last);
      sized_q.y_first <= at_least(y_low, turned_q.limits.y_first);
      sized_q.y_last  <= at_most(y_high, turned_q.limits.y_last);
    end
  end

  assign line_o   = sized_q.line;
  assign length_o = sized_q.length;
  assign drawn_o  = !sized_q.same && sized_q.x_first <= sized_q.x_last &&
                    sized_q.y_first <= sized_q.y_last;
  assign bounds_o = '{
    x_first: sized_q.x_first[PixelBits-1:0],
    x_last:  sized_q.x_last[PixelBits-1:0],
    y_first: sized_q.y_first[PixelBits-1:0],
    y_last:  sized_q.y_last[PixelBits-1:0]
  };

endmodule
