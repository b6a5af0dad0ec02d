// Where long words may be broken: browsers often lack the dictionaries that `hyphens: auto` needs.

import { currentLanguage, type Language } from "./language";
import hyphens from "./texts/hyphens.json";

const lists = hyphens as Partial<Record<Language, string[]>>;
const known = new Map<Language, Map<string, string[]>>();

/** Pieces of each long word of a language, in small letters. */
function wordsOf(language: Language): Map<string, string[]> {
  let words = known.get(language);
  if (!words) {
    const entries = (lists[language] ?? []).flatMap((line) => line.split(" "));
    words = new Map(entries.map((word) => [word.replaceAll("-", ""), word.split("-")]));
    known.set(language, words);
  }
  return words;
}

/** The text with soft hyphens in its long words. */
export function hyphenated(text: string): string {
  const words = wordsOf(currentLanguage());
  return text.replace(/\p{L}{9,}/gu, (word) => {
    let at = 0;
    return words.get(word.toLowerCase())?.map((piece) => word.slice(at, (at += piece.length))).join("\u00ad") ?? word;
  });
}
