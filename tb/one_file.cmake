# Writes ALL, which includes every source that Verilator has written into DIR: their names are known only now.
file(GLOB sources ${DIR}/*.cpp)
list(REMOVE_ITEM sources ${ALL})
list(SORT sources)
list(TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"")
list(JOIN sources "\n" text)
file(WRITE ${ALL} "${text}\n")
