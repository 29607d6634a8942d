# A scene as mpm-verify hands it over (TOML, docs/protocol.md), as assignments for a shell: TABLE_KEY='VALUE', a list with blanks between its values.
function plain(name) { gsub(/[^A-Za-z0-9_]/, "_", name); return name }
/^[ \t]*#/ || /^[ \t]*$/ { next }
/^\[/ { table = $0; sub(/^\[+/, "", table); sub(/\].*$/, "", table); next }
{
  at = index($0, "=")
  key = substr($0, 1, at - 1); value = substr($0, at + 1)
  gsub(/[ \t]/, "", key); sub(/^[ \t]+/, "", value); sub(/[ \t]+$/, "", value)
  if (value ~ /^\[/) { gsub(/[][,]/, " ", value) }
  gsub(/"/, "", value); gsub(/'/, "", value)
  print plain(table "_" key) "='" value "'"
}
