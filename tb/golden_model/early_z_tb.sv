// The golden model on both sides of a design: it makes the packets that drive early_z, out of random triangles, and
// checks what early_z makes of them; at the end, that memory holds the depth it should.
//
// Two depth surfaces of different formats lie one behind the other in a memory of this bench.
//   +packets=N  triangles (200); the other arguments are those of edge_evaluator_tb

module early_z_tb;
  import raster_pkg::*;
  import halfspace_dpi::*;

  localparam int unsigned Size = 64;  // pixels on a side of a surface
  localparam int unsigned Columns = Size / TileSize;
  localparam int unsigned SurfaceTiles = Columns * Columns;
  localparam int unsigned MemoryTiles = 2 * SurfaceTiles;
  localparam int unsigned TileBits = $clog2(MemoryTiles);
  localparam int unsigned LineBytes = 4 * MaskBits / ZParts;  // of a line that is not half
  localparam int unsigned PortBytes = LineBytes < 64 ? LineBytes : 64;
  localparam int unsigned TileBytes = LineBytes * ZParts;

  localparam int Unorm16 = 1;
  localparam int Float32 = 4;

  typedef struct packed {
    screen_triangle_t triangle;
    draw_state_t      state;
  } triangle_link_t;

  typedef struct packed {
    logic [SlotBits-1:0] slot;
    depth_equation_t     equation;
    draw_state_t         state;
  } slot_link_t;

  logic clk = 1'b0;
  logic rst_n = 1'b0;

  logic                   slot_valid = 1'b0;
  slot_link_t             slot;
  logic                   beat_valid = 1'b0;
  logic                   beat_ready;
  quad_beat_t             beat;
  logic                   dut_valid, dut_ready;
  tested_beat_t           dut_beat;
  logic                   tested_valid, tested_ready;
  tested_beat_t           tested;
  logic                   read_valid, read_half, fill_valid;
  logic [LineBits-1:0]    read_line;
  logic [8*PortBytes-1:0] fill_data;
  logic                   write_valid, write_last;
  logic [LineBits-1:0]    write_line;
  logic [8*PortBytes-1:0] write_data;
  logic                   unit_idle, clear_done, flush_done;
  logic                   clear = 1'b0;
  logic                   flush = 1'b0;
  logic [TileBits-1:0]    clear_first, clear_last;

  early_z #(
    .Lines       (16),
    .Ways        (2),
    .MemoryTiles (MemoryTiles)
  ) u_dut (
    .clk_i           (clk),
    .rst_ni          (rst_n),
    .slot_write_i    (slot_valid),
    .slot_i          (slot.slot),
    .slot_equation_i (slot.equation),
    .slot_state_i    (slot.state),
    .beat_valid_i    (beat_valid),
    .beat_ready_o    (beat_ready),
    .beat_i          (beat),
    .beat_valid_o    (dut_valid),
    .beat_ready_i    (dut_ready),
    .beat_o          (dut_beat),
    .late_valid_i    (1'b0),
    .late_keep_i     ('0),
    .read_valid_o    (read_valid),
    .read_ready_i    (1'b1),
    .read_line_o     (read_line),
    .read_half_o     (read_half),
    .fill_valid_i    (fill_valid),
    .fill_data_i     (fill_data),
    .write_valid_o   (write_valid),
    .write_ready_i   (1'b1),
    .write_line_o    (write_line),
    .write_last_o    (write_last),
    .write_data_o    (write_data),
    .idle_o          (unit_idle),
    .clear_valid_i   (clear),
    .clear_first_i   (clear_first),
    .clear_last_i    (clear_last),
    .clear_done_o    (clear_done),
    .flush_i         (flush),
    .flush_done_o    (flush_done)
  );

  link_fault #(
    .Width ($bits(tested_beat_t))
  ) u_fault (
    .clk_i   (clk),
    .rst_ni  (rst_n),
    .valid_i (dut_valid),
    .ready_o (dut_ready),
    .data_i  (dut_beat),
    .valid_o (tested_valid),
    .ready_i (tested_ready),
    .data_o  (tested)
  );

  // Memory, as wide as its ports. A line takes LineBytes, and half of them where it has 2 bytes a sample.
  localparam int unsigned LinePorts = LineBytes / PortBytes;

  logic [8*PortBytes-1:0] memory [MemoryTiles * ZParts * LinePorts];
  logic [LineBits-1:0]    request_line [$];
  logic                   request_half [$];
  int unsigned            fill_port, write_port;  // port's widths of a line that are done

  function automatic int unsigned ports_of(logic half);
    return half && LinePorts > 1 ? LinePorts / 2 : LinePorts;
  endfunction

  always @(posedge clk) begin
    fill_valid   <= 1'b0;
    tested_ready <= 2'($urandom) != 0;
    if (!rst_n) begin
      fill_port  <= 0;
      write_port <= 0;
      request_line.delete();
      request_half.delete();
    end else begin
      if (request_line.size() != 0 && 2'($urandom) != 0) begin
        fill_valid <= 1'b1;
        fill_data  <= memory[request_line[0] * LinePorts + fill_port];
        fill_port  <= fill_port + 1;
        if (fill_port + 1 == ports_of(request_half[0])) begin
          fill_port <= 0;
          void'(request_line.pop_front());
          void'(request_half.pop_front());
        end
      end
      if (read_valid) begin
        request_line.push_back(read_line);
        request_half.push_back(read_half);
      end
      if (write_valid) begin
        memory[write_line * LinePorts + write_port] <= write_data;
        write_port <= write_last ? 0 : write_port + 1;
      end
    end
  end

  scoreboard board;

  always @(posedge clk) begin
    if (rst_n && tested_valid && tested_ready) begin
      board.check(LinkTestedBeat, wire_packet_t'(tested), $bits(tested));
    end
  end

  int unsigned clear_code[2];

  // The stored code of depth 1.
  function automatic logic [CodeBits-1:0] largest_code(logic [FormatBits-1:0] format);
    return format == 1 ? 'hffff : format == 2 ? 'hff_ffff : format == 4 ? 'h3f80_0000 : '0;
  endfunction

  // Two triangles in three test depth on one of the surfaces; the others have none.
  function automatic triangle_link_t random_triangle();
    triangle_link_t next;
    int unsigned which;
    which = $urandom_range(2);
    next  = '0;
    for (int i = 0; i < 3; i++) begin
      next.triangle.x[i] = coord_t'($urandom_range(Size << SubPixelBits));
      next.triangle.y[i] = coord_t'($urandom_range(Size << SubPixelBits));
      next.triangle.z[i] = vertex_depth_t'($urandom_range('h3f80_0000));
    end
    next.state.x_last     = PixelBits'(Size - 1);
    next.state.y_last     = PixelBits'(Size - 1);
    next.state.format     = which == 0 ? '0 : FormatBits'(which == 1 ? Unorm16 : Float32);
    next.state.test       = which != 0;
    next.state.write      = FlagBits'($urandom);
    next.state.most_code  = largest_code(next.state.format);
    next.state.func       = FuncBits'($urandom);
    next.state.clear_code = clear_code[which == 2];
    next.state.first_tile = which == 2 ? SurfaceTiles : 0;
    next.state.tiles_x    = TileCoordBits'(Columns - 1);
    return next;
  endfunction

  task automatic clear_surface(int unsigned which);
    clear_code[which] = $urandom_range(which == 0 ? 'hffff : 'h3f80_0000);
    board.clear_surface(which * SurfaceTiles, clear_code[which]);
    do @(negedge clk); while (!unit_idle);
    clear       = 1'b1;
    clear_first = TileBits'(which * SurfaceTiles);
    clear_last  = TileBits'((which + 1) * SurfaceTiles - 1);
    @(negedge clk) clear = 1'b0;
    while (!clear_done) @(negedge clk);
  endtask

  // The beats of a burst come without a gap, so those of all bursts do here.
  task automatic send(triangle_link_t triangle);
    packet_t packet;
    packet = '0;
    board.put(LinkTriangle, wire_packet_t'(triangle), $bits(triangle));
    while (board.get(LinkSlot, packet, $bits(slot_link_t))) begin
      @(negedge clk);
      slot       = slot_link_t'(packet);
      slot_valid = 1'b1;
    end
    @(negedge clk) slot_valid = 1'b0;
    while (board.get(LinkQuadBeat, packet, $bits(quad_beat_t))) begin
      beat       = quad_beat_t'(packet);
      beat_valid = 1'b1;
      do @(posedge clk); while (!beat_ready);
      @(negedge clk);
    end
    beat_valid = 1'b0;
  endtask

  function automatic int unsigned depth_in_memory(int unsigned which, int unsigned x,
                                                  int unsigned y);
    int unsigned tile, sample, bytes, first;
    bytes  = which == 0 ? 2 : 4;
    tile   = which * SurfaceTiles + y / TileSize * Columns + x / TileSize;
    sample = y % TileSize * TileSize + x % TileSize;
    first  = tile * TileBytes + sample / (MaskBits / ZParts) * LineBytes +
             sample % (MaskBits / ZParts) * bytes;
    return 32'(memory[first / PortBytes] >> (8 * (first % PortBytes))) &
           (which == 0 ? 'hffff : 'hffff_ffff);
  endfunction

  initial forever #5 clk = !clk;

  int unsigned packets, seed, looked, wrong;

  initial begin
    if ($value$plusargs("packets=%d", packets) == 0) packets = 200;
    if ($value$plusargs("seed=%d", seed) == 0) seed = 1;
    void'($urandom(seed));
    board = new();
    board.set($sformatf("block_walker.block_size=%0d", BlockSize));
    board.set($sformatf("tile_walker.tile_size=%0d", TileSize));
    board.set($sformatf("raster.sub_pixel_bits=%0d", SubPixelBits));
    board.set($sformatf("quad_generator.quads_per_cycle=%0d", QuadWidth));
    board.set($sformatf("early_z.quads_per_cycle=%0d", TestWidth));
    board.set($sformatf("z_cache.parts=%0d", ZParts));
    board.watch(LinkSlot, $bits(slot_link_t));
    board.watch(LinkQuadBeat, $bits(quad_beat_t));
    board.watch(LinkTestedBeat, $bits(tested_beat_t));
    board.define_surface(0, Unorm16, int'(Size), int'(Size), 0);
    board.define_surface(SurfaceTiles, Float32, int'(Size), int'(Size), 0);

    repeat (4) @(posedge clk);
    @(negedge clk) rst_n = 1'b1;
    clear_surface(0);
    clear_surface(1);
    for (int unsigned i = 0; i < packets; i++) begin
      if ($urandom_range(30) == 0 && i + 20 < packets) begin
        clear_surface($urandom_range(1));
      end
      send(random_triangle());
    end
    do @(negedge clk); while (!unit_idle);
    flush = 1'b1;
    @(negedge clk) flush = 1'b0;
    while (!flush_done) @(negedge clk);

    // Lines that were cleared and never touched are not in memory.
    looked = 0;
    wrong  = 0;
    for (int unsigned which = 0; which < 2; which++) begin
      for (int unsigned y = 0; y < Size; y++) begin
        for (int unsigned x = 0; x < Size; x++) begin
          int unsigned want;
          want = board.read_depth(which * SurfaceTiles, int'(x), int'(y));
          if (want != clear_code[which]) begin
            looked++;
            wrong += depth_in_memory(which, x, y) == want ? 0 : 1;
          end
        end
      end
    end
    $display("depth in memory: %0d pixels compared, %0d differ", looked, wrong);
    if (!board.finish() || looked == 0 || wrong != 0) begin
      $fatal(1, "the design differs from the model");
    end
    $finish;
  end

endmodule
