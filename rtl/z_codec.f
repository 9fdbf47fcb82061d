raster_pkg.sv
z_codec_pkg.sv
z_extremes_stage.sv
z_encode_plane.sv
z_encode_ends.sv
z_encoder.sv
z_decoder.sv
