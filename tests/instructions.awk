# instructions.awk - turns a disassembly (objdump -dw of an archive) into source that an assembler takes: each distinct
# instruction once, in FOLDER/GROUP.s, beside the object that it was seen in. Used by objects.sh.
#
# Variables: folder; machine: x86-64, aarch64, arm or riscv64; isas: the instruction sets that files are named after, with a
# space before and after each. A group holds the files of one instruction set, "base" those of none.
BEGIN {
  FS = "\t"
  count = split("eq ne cs cc mi pl vs vc hi ls ge lt gt le", names, " ")
  for (i = 1; i < count; i += 2) {
    inverse[names[i]] = names[i + 1]
    inverse[names[i + 1]] = names[i]
  }
}

# Thumb's blocks of conditions and of predicated vectors: each of their instructions gets a block of its own.
function blocks(text,  condition, opener) {
  if (conditions != "") {
    condition = conditions ~ /^t/ ? first : inverse[first]
    conditions = substr(conditions, 2)
    return "it " condition "; " text
  }
  if (match(text, /^it[te]* /)) {
    conditions = substr(text, 2, RLENGTH - 2)
    first = substr(text, RLENGTH + 1, 2)
    return ""
  }
  if (predicated > 0) {
    predicated--
    match(text, /[. ]/)  # the letter before is t or e
    return "vpst; " substr(text, 1, RSTART - 2) "t" substr(text, RSTART)
  }
  if (text ~ /^vps?t[te]*([. ]|$)/) {
    match(text, /^vps?t[te]*/)
    opener = text ~ /^vps/ ? "vpst" : "vpt"
    predicated = 1 + RLENGTH - length(opener)
    return opener substr(text, RLENGTH + 1) "; vmovt q0, q0"
  }
  return text
}

/ file format / {
  object = $1
  sub(/: +file format .*/, "", object)
  name = object
  sub(/\..*/, "", name)
  group = name
  sub(/.*_/, "", group)
  if (name == "cpu_x86" && machine == "x86-64") group = name
  else if (index(isas, " " group " ") == 0 || group == "scalar") group = "base"
  next
}

NF >= 3 && $1 ~ /^ *[0-9a-f]+:$/ {
  text = $3
  for (i = 4; i <= NF; i++) text = text " " $i
  sub(/ *(\/\/|@|#[ \t]+[0-9a-f]+ <|;).*/, "", text)  # comments
  gsub(/(0x)?[0-9a-f]+ <[^>]*>/, ". + 8", text)       # targets of branches
  gsub(/ +/, " ", text)
  sub(/ $/, "", text)
  if (machine == "x86-64") {
    # A long encoding may read like a shorter one.
    if ($2 ~ /^((26|2e|36|3e|64|65|67) )*62 /) text = "{evex} " text
    # Padding.
    if (text ~ /^((data16|cs) )*nop[wl]?( |$)/ || text == "xchg %ax,%ax") next
    # Without BMI the compiler means REP BSF, which older processors run as BSF.
    sub(/^tzcnt /, "bsf ", text)
    if (text ~ /^\.byte/) text = "undecodable " text
  } else {
    if (text ~ /^\.inst/) text = "undecodable " text
    if (text ~ /^\.(word|short|hword|byte)/) next  # constants, marked as data
    if (machine == "arm") {
      if (text ~ /^le(tp)? /) sub(/\. \+ /, ". - ", text)
      text = blocks(text)
      if (text == "") next
    }
  }
  if ((group, text) in seen) next
  seen[group, text]
  print text " /* " object " */" > (folder "/" group ".s")
}
