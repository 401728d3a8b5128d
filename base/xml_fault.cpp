#include "base/xml_fault.hpp"

namespace triptych {

std::string in_words(XML_Error error) {
  switch (error) {
    case XML_ERROR_NO_MEMORY:
      return "there is not enough memory to read it";
    case XML_ERROR_SYNTAX:
      return "an element in < and > is expected";
    case XML_ERROR_NO_ELEMENTS:
      return "it ends before its outermost element is closed";
    case XML_ERROR_INVALID_TOKEN:
      return "what stands here cannot; in a text < and & are written &lt; and &amp;";
    case XML_ERROR_UNCLOSED_TOKEN:
      return "what begins here has no end";
    case XML_ERROR_PARTIAL_CHAR:
      return "it ends within a letter";
    case XML_ERROR_TAG_MISMATCH:
      return "what is closed here is not the element that is open";
    case XML_ERROR_DUPLICATE_ATTRIBUTE:
      return "an element has two attributes of one name";
    case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
      return "nothing is expected after the outermost element";
    case XML_ERROR_UNDEFINED_ENTITY:
      return "a name between & and ; is not known; & itself is written &amp;";
    case XML_ERROR_BAD_CHAR_REF:
      return "there is no letter of the number between &# and ;";
    case XML_ERROR_MISPLACED_XML_PI:
      return "<?xml …?> stands at the very beginning, or nowhere";
    case XML_ERROR_XML_DECL:
      return "<?xml …?> is not well formed";
    case XML_ERROR_UNKNOWN_ENCODING:
    case XML_ERROR_INCORRECT_ENCODING:
      return "it is not in the encoding that it says, or that is not known; save it as UTF-8";
    case XML_ERROR_UNCLOSED_CDATA_SECTION:
      return "what begins with <![CDATA[ has no ]]>";
    case XML_ERROR_AMPLIFICATION_LIMIT_BREACH:
      return "what it abbreviates would be far larger than it";
    default:
      return "it is not well formed here";
  }
}

}  // namespace triptych
