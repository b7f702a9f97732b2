# Writes OUT, a C++ file that defines limen::embedded::SYMBOL as the text of FILE.
file(READ ${FILE} text)
file(WRITE ${OUT} "namespace limen::embedded {\n\nextern const char* const ${SYMBOL};\n"
                  "const char* const ${SYMBOL} = R\"text~(${text})text~\";\n\n}  // namespace limen::embedded\n")
