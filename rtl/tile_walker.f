raster_pkg.sv
credits.sv
memory_fifo.sv
credit_fifo.sv
pipe_register.sv
tile_edge.sv
tile_walker.sv
