/** All languages, for the page where no server is: in one file, or in a folder. */

import { language } from "../words/language_choice.js";
import { table as de } from "./de.js";
import { table as es } from "./es.js";
import { table as fr } from "./fr.js";

/** The sentences of the page's language by the English ones; none in English itself. */
export const sentences = { de, es, fr }[language] ?? {};
