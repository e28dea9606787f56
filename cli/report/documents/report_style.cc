#include "cli/report/documents/report_html.h"
#include "cli/report/html.h"

namespace errmap::report {
namespace {

constexpr const char* kStyle = R"css(
:root{color-scheme:light;--ink:#1b1f24;--soft:#4c5560;--line:#d5dae0;--paper:#fff;--tint:#f4f6f8;--mark:#e6f1fa;--blue:#0b5394;--good:#0a6b3d;--bad:#a33a00}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,"Noto Sans",sans-serif}
main,header,footer{max-width:1240px;margin:0 auto;padding:0 20px}
header{padding-top:18px}
h1{font-size:1.5rem;line-height:1.25;margin:0}
h2{font-size:1.3rem;line-height:1.3;margin:1.6rem 0 .6rem}
h3{font-size:1.12rem;margin:1.8rem 0 .5rem;padding-bottom:.25rem;border-bottom:1px solid var(--line)}
h4{font-size:1rem;margin:1.1rem 0 .35rem}
h1,h2,h3,h4,p,li,summary,figcaption,td,th{overflow-wrap:anywhere}
p{margin:.4rem 0;max-width:75ch}
a{color:var(--blue)}
.soft{color:var(--soft)}
.small{font-size:.875rem}
.answer{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,500px);gap:8px 36px;align-items:start;margin-top:.7rem}
.card{border:1px solid var(--line);border-left:6px solid var(--blue);border-radius:6px;padding:14px 18px;background:var(--tint)}
.sentence{font-size:1.12rem;line-height:1.4;font-weight:600;margin:0 0 .5rem}
.number{font-size:2.3rem;line-height:1.1;font-weight:700;margin:.2rem 0 0;white-space:nowrap}
.number+p{margin-top:.1rem}
.good{color:var(--good);font-weight:600}
.bad{color:var(--bad)}
ul{margin:.4rem 0;padding-left:1.3rem;font-size:.875rem}
.scroll{overflow-x:auto;margin:.4rem 0 1rem;border:1px solid var(--line);border-radius:4px;max-width:100%;width:fit-content;background:linear-gradient(90deg,#fff0,#fff 70%) 100% 0/40px 100% no-repeat local,linear-gradient(90deg,#0000,#0004) 100% 0/14px 100% no-repeat}
.scroll:focus-visible,.equation:focus-visible,summary:focus-visible,input:focus-visible,a:focus-visible{outline:3px solid var(--blue);outline-offset:2px}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums}
.index .scroll,.index table{width:100%}
th,td{padding:4px 10px;text-align:right;vertical-align:top;border-bottom:1px solid var(--line);overflow-wrap:normal}
tr:last-child td{border-bottom:0}
th{background:var(--tint);font-weight:600;vertical-align:bottom;max-width:12rem;overflow-wrap:break-word}
th .soft{font-weight:400;font-size:.8rem}
th.t,td.t{text-align:left}
td{white-space:nowrap}
td.long{white-space:normal;overflow-wrap:anywhere;min-width:15rem;max-width:34rem}
td:first-child,th:first-child{position:sticky;left:0;background:#fff}
th:first-child{background:var(--tint)}
tr.mark td,tr.mark td:first-child{background:var(--mark);font-weight:600}
tbody tr:hover td,tbody tr:hover td:first-child{background:#fff3d6}
.printed{display:none}
:target{background:var(--mark)}
.figures{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:18px 22px;align-items:start}
.span2{grid-column:span 2}.span3{grid-column:span 3}.figures>div{font-size:.875rem}.figures>div>:first-child{margin-top:0}
figure{margin:0;min-width:0;break-inside:avoid}
figcaption{font-size:.875rem;margin-bottom:.2rem}
figcaption b{display:block}
figure svg{display:block;width:100%;height:auto;background:#fff;font-family:system-ui,-apple-system,"Segoe UI",Roboto,Arial,"Noto Sans",sans-serif}
.words{fill:var(--ink)}.frame{stroke:var(--soft)}.grid{stroke:var(--line)}.paper{fill:var(--paper)}
.absent{border:1px dashed #8a94a0;border-radius:4px;padding:14px;color:var(--soft);font-size:.875rem;background:var(--tint)}
details{margin:.5rem 0}
summary{cursor:pointer;padding:.3rem 0;font-weight:600}
details.component{border:1px solid var(--line);border-radius:6px;padding:6px 16px;margin:.7rem 0}
details.component>summary{font-size:1.05rem}
details.component>summary span{font-weight:400;color:var(--soft)}
.equation{font:0.875rem/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,"Liberation Mono",monospace;background:var(--tint);border:1px solid var(--line);border-radius:4px;padding:8px 12px;overflow-wrap:anywhere;white-space:pre-wrap;margin:.4rem 0;max-height:16rem;overflow-y:auto}
.contents{max-width:none;font-size:.875rem;margin:1rem 0 .4rem}
.figures.halves{grid-template-columns:repeat(2,minmax(0,1fr))}
.next{display:grid;grid-template-columns:max-content minmax(0,1fr);gap:2px 12px;margin:.6rem 0;font-size:.875rem}
.next dt{font-weight:600}
.next dd{margin:0;overflow-wrap:anywhere}
code{font:.8125rem/1.45 ui-monospace,SFMono-Regular,Menlo,Consolas,"Liberation Mono",monospace;white-space:pre-wrap;background:var(--tint);padding:0 3px}code span{white-space:nowrap}
.spark{display:inline-block;vertical-align:middle;width:120px;height:18px}
.notice{border:1px solid #a33a00;background:#fff4ec;border-radius:6px;padding:8px 14px;margin:.8rem 0}
footer{border-top:1px solid var(--line);margin-top:2rem;padding-top:10px;padding-bottom:30px;font-size:.875rem;color:var(--soft)}
@media screen and (max-width:1000px){.answer,.figures,.figures.halves{grid-template-columns:minmax(0,1fr)}.span2,.span3{grid-column:auto}figure svg{max-width:520px}}
@media screen and (max-width:600px){main,header,footer{padding-left:14px;padding-right:14px}.card{padding:12px 14px}h1{font-size:1.3rem}.number{font-size:2rem}td:first-child{white-space:normal;overflow-wrap:anywhere;min-width:9.7rem}td.long:first-child{min-width:9.7rem}td.long{min-width:11rem}th,td{padding:4px 8px}.first2 th:nth-child(n+3),.first2 td:nth-child(n+3){display:none}.index th:nth-child(n+4):nth-child(-n+6),.index td:nth-child(n+4):nth-child(-n+6){display:none}.index td{white-space:normal}.index td:first-child{min-width:6rem}.first2::after,.index::after{content:"All columns: turn the phone.";font-size:.875rem;color:var(--soft)}}
@media print{@page{margin:10mm}
body{font-size:8.5pt;line-height:1.35}
main,header,footer{max-width:none;padding:0}
header{padding-top:0}h1{font-size:14pt}h2{font-size:12pt;margin:8pt 0 4pt}h3{font-size:10.5pt;margin:8pt 0 3pt}h4{margin:6pt 0 2pt}
p{margin:2pt 0}.small,figcaption,.next,ul,.figures>div{font-size:7.5pt}code{font-size:7pt}
.sentence{font-size:10pt;margin:0 0 3pt}.number{font-size:18pt}.card{padding:6pt 9pt}.next{margin:3pt 0;gap:1pt 8pt}
.scroll{overflow:visible;border:0;width:auto;margin:2pt 0}
table{font-size:7pt;width:100%}th .soft{font-size:6pt}th,td{padding:1px 3px}
td:first-child,th:first-child{position:static;min-width:0}td{white-space:nowrap}td:first-child,td.long{white-space:normal;min-width:0}
.answer{grid-template-columns:minmax(0,1fr) minmax(0,1.1fr);gap:4pt 12pt;margin-top:3pt}
.figures{gap:6pt 10pt}
.figures{grid-template-columns:repeat(3,minmax(0,1fr))}
.figures.halves{grid-template-columns:repeat(2,minmax(0,1fr))}
h2,h3,h4,summary{break-after:avoid}tr{break-inside:avoid}
.equation{max-height:none}
details.component:not([open])::details-content{content-visibility:visible;display:block}
details:not(.component):not([open]){display:none}
.contents,.back{display:none}
.printed{display:block}
details.component{border:0;padding:0;margin:0;break-before:page}
a{color:inherit;text-decoration:none}
.card,th,tr.mark td{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
)css";

}  // namespace

std::string PageHtml(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
         "charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<meta "
         "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" "
         "href=\"data:,\">\n<title>" +
         HtmlText(title) + "</title>\n<style>" + kStyle +
         "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace errmap::report
