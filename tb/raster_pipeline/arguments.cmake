# Writes Verilator's arguments for the machine of CONFIG, as PROGRAM prints them: one a line to LIST, and as a string
# literal to INCLUDE. Files that would be the same are left alone.
execute_process(COMMAND ${PROGRAM} config --config ${CONFIG} --rtl OUTPUT_VARIABLE arguments
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(CONFIGURE OUTPUT ${LIST} CONTENT "${arguments}\n")
string(REPLACE "\n" " " arguments "${arguments}")
file(CONFIGURE OUTPUT ${INCLUDE} CONTENT "\"${arguments}\"\n")
