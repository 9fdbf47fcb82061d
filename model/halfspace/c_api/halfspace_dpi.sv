// The golden model of halfspace.h in SystemVerilog: its functions by DPI-C, and a scoreboard made of them.
//
// Only what IEEE 1800-2017 says, so that any simulator takes it; link with libhalfspace_c.so. What each function does,
// takes and refuses is said in halfspace.h. docs/guides/golden_model.md shows how to use it, tb/golden_model runs it.

package halfspace_dpi;

  /// Bits that hold any packet of any configuration: 32 HALFSPACE_MAX_PACKET_WORDS.
  parameter int unsigned MaxPacketBits = 2560;

  /// A packet of any link, in its lowest bits.
  typedef bit [MaxPacketBits-1:0] packet_t;

  /// The same as it comes from a design, where bits may be unknown.
  typedef logic [MaxPacketBits-1:0] wire_packet_t;

  /// Links in the order of the units. One with several structs carries {first, second, ...}.
  typedef enum int {
    LinkTriangle      = 0,  // screen_triangle_t, draw_state_t
    LinkSetupTriangle = 1,  // setup_triangle_t, depth_equation_t, draw_state_t
    LinkSlot          = 2,  // slot, depth_equation_t, draw_state_t
    LinkBlockJob      = 3,  // block_job_t
    LinkTileJob       = 4,  // tile_job_t
    LinkCoverage      = 5,  // coverage_t
    LinkQuadBeat      = 6,  // quad_beat_t
    LinkTestedBeat    = 7   // tested_beat_t
  } link_e;

  /// What the functions return that give an int.
  typedef enum int {
    StatusOk        = 0,
    StatusNone      = 1,
    StatusDifferent = 2,
    StatusRefused   = -1,
    StatusNoMemory  = -2,
    StatusInternal  = -3
  } status_e;

  /// The halfspace.h that this file goes with.
  parameter int AbiVersion = 7;

  import "DPI-C" function string halfspace_version();
  import "DPI-C" function int halfspace_abi_version();
  import "DPI-C" function chandle halfspace_create();
  import "DPI-C" function void halfspace_destroy(input chandle model);
  import "DPI-C" function string halfspace_error(input chandle model);
  import "DPI-C" function int halfspace_configure_file(input chandle model, input string path);
  import "DPI-C" function int halfspace_configure(input chandle model, input string toml);
  import "DPI-C" function int halfspace_set(input chandle model, input string assignment);
  import "DPI-C" function int halfspace_packet_bits(input chandle model, input int link);
  import "DPI-C" function string halfspace_link_name(input int link);
  import "DPI-C" function int halfspace_watch(input chandle model, input int link);
  import "DPI-C" function int halfspace_put(
      input chandle model, input int link, input packet_t packet, input int bits);
  import "DPI-C" function int halfspace_get(
      input chandle model, input int link, inout packet_t packet, input int bits);
  import "DPI-C" function int halfspace_check(
      input chandle model, input int link, input packet_t packet, input int bits);
  import "DPI-C" function longint halfspace_pending(input chandle model, input int link);
  import "DPI-C" function int halfspace_reset(input chandle model);
  import "DPI-C" function int halfspace_define_surface(
      input chandle model, input int unsigned first_tile, input int format, input int width,
      input int height, input int unsigned code);
  import "DPI-C" function int halfspace_clear_surface(
      input chandle model, input int unsigned first_tile, input int unsigned code);
  import "DPI-C" function int halfspace_read_depth(
      input chandle model, input int unsigned first_tile, input int x, input int y,
      inout int unsigned code);
  import "DPI-C" function int halfspace_write_depth(
      input chandle model, input int unsigned first_tile, input int x, input int y,
      input int unsigned code);

  /// Compares what comes out of a design with what the model expects.
  ///
  /// configure, watch; then put() each packet that the design takes and check() each that it gives, in the order of
  /// time and, within a cycle, put() first; at the end finish(). Differences are printed and counted, up to MostMessages
  /// of them in full; what makes no sense (a configuration, a size) ends the simulation.
  // verilator lint_off DECLFILENAME
  class scoreboard;  // the file is named after the package
  // verilator lint_on DECLFILENAME

    localparam int unsigned MostMessages = 10;
    localparam int Links = 8;

    local chandle model;
    local bit watched[Links];
    local int unsigned compared_count;
    local int unsigned failed_count;

    function new();
      model = halfspace_create();
      if (model == null) begin
        $fatal(1, "halfspace: out of memory");
      end
      if (halfspace_abi_version() != AbiVersion) begin
        $fatal(1, "halfspace: the library has ABI version %0d, halfspace_dpi.sv %0d",
               halfspace_abi_version(), AbiVersion);
      end
    endfunction

    /// A machine from a TOML file; see `halfspace config`.
    function void configure_file(string path);
      demand(halfspace_configure_file(model, path));
    endfunction

    /// One key: "tile_walker.tile_size=16".
    function void set(string assignment);
      demand(halfspace_set(model, assignment));
    endfunction

    /// Expects packets of `bits` bits on a link; the design's $bits must be the model's.
    function void watch(link_e link, int bits);
      if (bits != halfspace_packet_bits(model, link)) begin
        $fatal(1, "halfspace: a packet on link %s has %0d bits, the model's %0d",
               halfspace_link_name(link), bits, halfspace_packet_bits(model, link));
      end
      demand(halfspace_watch(model, link));
      watched[link] = 1'b1;
    endfunction

    /// A packet that the design has taken.
    function void put(link_e link, wire_packet_t packet, int bits);
      if ($isunknown(packet)) begin
        fail($sformatf("packet on link %s: unknown bits", halfspace_link_name(link)));
      end else if (halfspace_put(model, link, packet, bits) != StatusOk) begin
        fail(halfspace_error(model));
      end
    endfunction

    /// A packet that the design has given.
    function void check(link_e link, wire_packet_t packet, int bits);
      int status;
      status = halfspace_check(model, link, packet, bits);
      compared_count++;
      if ($isunknown(packet)) begin
        fail($sformatf("packet on link %s: unknown bits", halfspace_link_name(link)));
      end else if (status != StatusOk) begin
        fail(halfspace_error(model));
      end
    endfunction

    /// The next packet that is expected on a watched link, which is then not to be checked: for benches that drive a
    /// design with what the units in front of it give. 0 when there is none.
    function bit get(link_e link, output packet_t packet, input int bits);
      int status;
      packet = '0;
      status = halfspace_get(model, link, packet, bits);
      if (status != StatusNone) begin
        demand(status);
      end
      return status == StatusOk;
    endfunction

    /// The design is reset.
    function void reset();
      demand(halfspace_reset(model));
    endfunction

    /// A depth surface, all of it `code`; see halfspace.h.
    function void define_surface(int unsigned first_tile, int format, int width, int height,
                                 int unsigned code);
      demand(halfspace_define_surface(model, first_tile, format, width, height, code));
    endfunction

    function void clear_surface(int unsigned first_tile, int unsigned code);
      demand(halfspace_clear_surface(model, first_tile, code));
    endfunction

    function int unsigned read_depth(int unsigned first_tile, int x, int y);
      int unsigned code;
      code = 0;
      demand(halfspace_read_depth(model, first_tile, x, y, code));
      return code;
    endfunction

    function void write_depth(int unsigned first_tile, int x, int y, int unsigned code);
      demand(halfspace_write_depth(model, first_tile, x, y, code));
    endfunction

    /// Packets compared so far, and how often something was wrong.
    function int unsigned compared();
      return compared_count;
    endfunction

    function int unsigned failed();
      return failed_count;
    endfunction

    /// Packets that are expected still.
    function longint pending();
      longint sum;
      sum = 0;
      for (int i = 0; i < Links; i++) begin
        if (watched[i]) begin
          sum += halfspace_pending(model, i);
        end
      end
      return sum;
    endfunction

    /// The verdict, printed: 1 when all that was expected came and nothing else did. Frees the model.
    function bit finish();
      for (int i = 0; i < Links; i++) begin
        if (watched[i] && halfspace_pending(model, i) != 0) begin
          fail($sformatf("%0d packets never came on link %s", halfspace_pending(model, i),
                         halfspace_link_name(i)));
        end
      end
      $display("%s: %0d packets compared, %0d failures",
               failed_count == 0 && compared_count != 0 ? "PASS" : "FAIL", compared_count,
               failed_count);
      halfspace_destroy(model);
      model = null;
      return failed_count == 0 && compared_count != 0;
    endfunction

    local function void fail(string message);
      failed_count++;
      if (failed_count <= MostMessages) begin
        $display("%0t: %s", $time, message);
      end
    endfunction

    local function void demand(int status);
      if (status != StatusOk) begin
        $fatal(1, "halfspace: %s", halfspace_error(model));
      end
    endfunction

  endclass

endpackage : halfspace_dpi
