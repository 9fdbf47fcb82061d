raster_pkg.sv
credits.sv
memory_fifo.sv
credit_fifo.sv
pipe_register.sv
block_position.sv
block_edge.sv
block_walker.sv
